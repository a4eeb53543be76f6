"""One worker, seen from the grader: a fork of the parent, and the wire to it."""

from exercises.grader.sandbox import nursery as home
from exercises.grader.sandbox.wire import Wire


class Worker:
    """One fork of the parent, and the wire to it."""

    def __init__(self, kind, limits):
        self.kind, self.wire = kind, Wire()
        try:
            self.pid = home.nursery(kind).spawn(limits, self.wire)
        except home.SandboxError:
            home.forget(kind)  # once more, with a new parent: that one may have fallen to a lack of memory
            self.pid = home.nursery(kind).spawn(limits, self.wire)
        self.wire.release()

    def end(self):
        self.wire.close()
        try:
            return home.nursery(self.kind).end(self.pid)
        except home.SandboxError:
            home.forget(self.kind)
            return None, 0.0
