"""One worker, seen from the grader: a fork of the parent, and the wire to it."""

from exercises.grader.sandbox import nursery as home
from exercises.grader.sandbox.wire import Wire


class Worker:
    """One fork of the parent, and the wire to it."""

    def __init__(self, kind, limits, tools=False):
        self.home, self.wire = (kind, tools), Wire()
        try:
            self.pid = home.nursery(*self.home).spawn(limits, self.wire)
        except home.SandboxError:
            home.forget(*self.home)  # once more, with a new parent: that one may have lacked memory
            self.pid = home.nursery(*self.home).spawn(limits, self.wire)
        self.wire.release()

    def end(self):
        self.wire.close()
        try:
            return home.nursery(*self.home).end(self.pid)
        except home.SandboxError:
            home.forget(*self.home)
            return None, 0.0
