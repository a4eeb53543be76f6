"""Tries to break out of the sandbox, in a worker that is shut in as a student's would be."""

import ctypes
import os
import signal
import socket
import subprocess
import threading


def sing(secret, witness, scratch):
    """Names of what got through, or did not work that must. `secret` is a file that must not be read,
    `witness` a process that must not be reached."""
    attempts = {
        "reads a file outside": lambda: open(secret).close(),
        "lists a folder outside": lambda: os.listdir(os.path.dirname(secret)),
        "writes a file outside": lambda: open(secret + ".written", "w").close(),
        "empties a file outside": lambda: _changes(secret, lambda: os.truncate(secret, 0)),
        "empties a file by reading it": lambda: _changes(
            secret, lambda: os.open(secret, os.O_RDONLY | os.O_TRUNC)
        ),
        "changes a file's mode": lambda: _changes(secret, lambda: os.chmod(secret, 0o600)),
        "changes a file's time": lambda: _changes(secret, lambda: os.utime(secret, (1, 1))),
        "opens a socket": lambda: socket.socket(),
        "forks": _fork,
        "runs a program": lambda: subprocess.run(["/bin/true"], check=True),
        "signals another process": lambda: os.kill(witness, 0),
        "signals its group": lambda: os.kill(0, signal.SIGCONT),
        "reads another process": lambda: open(f"/proc/{witness}/environ").close(),
        "uses /dev/shm": lambda: open("/dev/shm/canary", "w").close(),
        "makes a file in memory": lambda: os.memfd_create("canary"),
        "becomes root": lambda: os.setuid(0) if os.getuid() else os.chroot("/"),
        "makes a namespace": _namespace,
        "takes more memory than allowed": lambda: bytearray(1 << 38),
    }
    through = [name for name, attempt in attempts.items() if _works(attempt)]
    needs = {"starts no thread": _thread, "writes no file of its own": lambda: _write(scratch)}
    return through + [name for name, need in needs.items() if not _works(need)]


def _works(attempt):
    try:
        attempt()
    except (OSError, MemoryError, RuntimeError, ValueError):
        return False
    return True


def _changes(path, attempt):
    before = os.stat(path)
    attempt()
    if os.stat(path) == before:
        raise OSError("nothing changed")


def _fork():
    if os.fork() == 0:
        os._exit(0)


def _namespace():
    if ctypes.CDLL(None).unshare(0x10000000) != 0:
        raise OSError


def _thread():
    done = []
    thread = threading.Thread(target=done.append, args=(1,))
    thread.start()
    thread.join()
    if not done:
        raise OSError


def _write(scratch):
    with open(os.path.join(scratch, "canary"), "w") as file:
        file.write("x")
