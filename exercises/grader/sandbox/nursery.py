"""The parent processes of a grader, one with the large tools and one without: each started at its first use,
in the best isolation that works here, and ended with the grader."""

import atexit
import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
from multiprocessing.util import Finalize
from pathlib import Path

from exercises.grader.sandbox import bubblewrap, folder, limits
from exercises.grader.sandbox.survey import ROOT, command, environment, survey

START = (
    "import json, sys; sys.path += json.loads(sys.argv[1]); "
    "from exercises.grader.sandbox.parent import main; main(int(sys.argv[2]))"
)
LONGEST_START, LONGEST_ANSWER = 120.0, 30.0
FIRST_FREE_USER, FREE_USERS = 61184, 4000  # numbers that systems leave for users made as needed
KINDS = ("bubblewrap", "landlock", "landlock, scratch on disk", "none")


class NoSandbox(RuntimeError):
    """No kind of isolation works here."""


class SandboxError(RuntimeError):
    """The sandbox itself failed: a fault of ours or of the machine, not of a student."""


class Nursery:
    """One parent process in one kind of isolation, with or without the large tools loaded."""

    def __init__(self, kind, tools=False):
        self.kind, self.tools = kind, tools
        self.folder, self.lock = folder.make()
        self.complaints = open(self.folder.with_suffix(".err"), "w+b")  # noqa: SIM115 (closed with the nursery)
        os.unlink(self.complaints.name)
        try:
            self._start()
        except BaseException:
            self.close()
            raise

    def _start(self):
        self.link, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.link.settimeout(LONGEST_START)
        known, user = survey(), user_of_workers()
        inside = self.kind == "bubblewrap"
        self.scratch = bubblewrap.SCRATCH if inside else self._make_scratch(user)
        path = json.dumps([bubblewrap.COURSE if inside else str(ROOT), *known.path])
        program = command(("-c", START), path, str(theirs.fileno()))
        with theirs:
            self.process = subprocess.Popen(
                bubblewrap.command(program, known) if inside else program,
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=self.complaints, cwd="/",
                pass_fds=(theirs.fileno(),), start_new_session=True, env=environment(self.scratch),
            )  # fmt: skip
        machine = {
            "landlock": self.kind.startswith("landlock"), "confined": self.kind != "none",
            "scratch": self.scratch,
            "private_scratch": self.kind in ("bubblewrap", "landlock"), "user": user,
            "tools": self.tools, "loaded": known.loaded[self.tools],
            "processes": most_processes(user), "readable": known.readable, "listable": known.listable,
        }  # fmt: skip
        self._ask({"start": machine})
        self.link.settimeout(LONGEST_ANSWER)

    def _make_scratch(self, user):
        scratch = self.folder / "around" / "scratch"
        scratch.parent.mkdir(mode=0o755)
        scratch.mkdir(mode=0o700)
        if user is not None:
            os.chown(scratch, user, user)
        return str(scratch)

    def spawn(self, given_limits, wire):
        """A new worker at the other end of the wire: its number."""
        return self._ask({"spawn": given_limits.as_dict()}, wire.theirs)["pid"]

    def end(self, pid):
        """Kills the worker; (exit code, negative for a signal; CPU seconds that it took)."""
        answer = self._ask({"end": pid})
        return answer["code"], answer["cpu"]

    def _ask(self, message, files=()):
        try:
            data = json.dumps(message).encode()
            socket.send_fds(self.link, [data], files) if files else self.link.sendall(data)
            text = self.link.recv(1 << 16)
        except OSError as error:
            said = f"{error}; {self.last_words()}"
            raise SandboxError(f"the sandbox's parent process does not answer ({said})") from None
        if not text:
            raise SandboxError(f"the sandbox's parent process ended: {self.last_words()}")
        answer = json.loads(text)
        if "error" in answer:
            raise SandboxError(f"the sandbox's parent process says: {answer['error']}")
        return answer

    def last_words(self):
        self.complaints.seek(0)
        return self.complaints.read()[-400:].decode("utf-8", "replace").strip() or "it said nothing"

    def close(self):
        if hasattr(self, "process"):
            self.link.close()  # the parent's sign to kill its workers and go
            try:
                self.process.wait(3)
            except subprocess.TimeoutExpired:
                os.killpg(self.process.pid, signal.SIGKILL)  # its workers, too
                self.process.wait()
        self.complaints.close()
        self.lock.close()
        shutil.rmtree(self.folder, ignore_errors=True)


def user_of_workers():
    """As root: a user whom nobody else is, since limits do not bind root. Else None: workers are the user's;
    so, too, for the root of a container that has no such user."""
    user = FIRST_FREE_USER + os.getpid() % FREE_USERS
    spans = [tuple(map(int, line.split())) for line in Path("/proc/self/uid_map").read_text().splitlines()]
    known = any(first <= user < first + count for first, _, count in spans)
    return user if os.getuid() == 0 and known else None


def most_processes(user):
    """What the user may have, in threads: for its own user that many, else so many more than there are
    now."""
    if user is not None:
        return limits.THREADS
    count = 0
    for status in Path("/proc").glob("[0-9]*/status"):
        with contextlib.suppress(OSError, ValueError, KeyError):
            fields = dict(line.split(":", 1) for line in status.read_text().splitlines() if ":" in line)
            if int(fields["Uid"].split()[0]) == os.getuid():
                count += int(fields["Threads"])
    return count + limits.THREADS + 256


_current = {}  # (kind, tools, process) → Nursery


def nursery(kind, tools=False):
    """This process's nursery of that kind, started if need be."""
    here = (kind, tools, os.getpid())
    if here not in _current:
        _current[here] = Nursery(kind, tools)
    return _current[here]


def forget(kind, tools=False):
    """The nursery has failed: the next question starts a new one."""
    broken = _current.pop((kind, tools, os.getpid()), None)
    if broken is not None:
        broken.close()


def close():
    """Ends this process's sandboxes."""
    for kind, tools, process in list(_current):
        if process == os.getpid():
            forget(kind, tools)


atexit.register(close)
Finalize(None, close, exitpriority=0)  # a process of multiprocessing ends without atexit
