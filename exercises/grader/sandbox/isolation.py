"""Which isolation works here: found by sending a canary into each, not by looking for a program."""

import functools
import json
import os
import sys
from dataclasses import dataclass, field

from exercises.grader.sandbox import bubblewrap
from exercises.grader.sandbox.limits import Limits
from exercises.grader.sandbox.nursery import NoSandbox, SandboxError, forget, nursery
from exercises.grader.sandbox.wire import Gone, Wire

PATIENCE = 30.0
DISABLE = "GRADER_WITHOUT"  # for tests: kinds that are taken as not there, with commas between


@dataclass(frozen=True)
class Isolation:
    kind: str | None  # of nursery.KINDS, None where none works
    reasons: dict = field(default_factory=dict)  # for each kind that was tried: "ok", or why not

    @property
    def name(self):
        return (self.kind or "").split(",")[0]

    def sentence(self):
        tried = "; ".join(f"{kind}: {reason}" for kind, reason in self.reasons.items())
        return f"no sandbox works here ({tried})"


@functools.cache
def _probe(process):
    if sys.platform != "linux":
        return Isolation(
            None, {sys.platform: "sandboxes are Linux's: run it in a Linux container, or in WSL2"}
        )
    reasons = {}
    for kind in ("bubblewrap", "landlock", "landlock, scratch on disk"):
        reasons[kind] = trouble(kind)
        if reasons[kind] == "ok":
            return Isolation(kind, reasons)
    return Isolation(None, reasons)


def probe():
    """The best isolation that works here, tried once a process."""
    return _probe(os.getpid())


def choose(unsafe=False):
    """The kind to use; NoSandbox where none works and `unsafe` does not allow to go without."""
    found = probe()
    if found.kind is not None:
        return found.kind
    if unsafe and sys.platform == "linux":
        return "none"
    raise NoSandbox(found.sentence())


def trouble(kind):
    """ "ok", or why this kind cannot be used."""
    if kind.split(",")[0] in os.environ.get(DISABLE, "").split(",") or kind in os.environ.get(
        DISABLE, ""
    ).split(";"):
        return f"switched off by {DISABLE}"
    if kind == "bubblewrap" and not bubblewrap.available():
        return "the program bwrap is not installed"
    if kind.startswith("landlock"):
        from exercises.grader.sandbox import landlock, seccomp

        if not landlock.version():
            return "this kernel has no Landlock"
        if not seccomp.supported():
            return "no list of system calls is known for this kind of processor"
    try:
        through = send_canary(nursery(kind))
    except (SandboxError, OSError, Gone) as error:
        through = [str(error)]
    if through:
        forget(kind)
        return f"a canary {', '.join(through)}" if not isinstance(through, str) else through
    return "ok"


def send_canary(home):
    """What a worker of this nursery can do that it must not."""
    secret = home.folder / "secret"
    secret.write_text("not for students")
    request = {"secret": str(secret), "witness": os.getpid(), "scratch": home.scratch}
    wire = Wire()
    pid = home.spawn(Limits(), wire)
    wire.release()
    try:
        wire.send(json.dumps({"canary": request}).encode() + b"\n", PATIENCE)
        answer = json.loads(wire.line(PATIENCE, 1 << 16))
    finally:
        wire.close()
        home.end(pid)
    if "unconfined" in answer:
        return [f"could not be shut in ({answer['unconfined']})"]
    return answer["canary"]
