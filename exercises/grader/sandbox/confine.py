"""A worker shuts itself in, for good, before it reads anything of a student's."""

import contextlib
import fcntl
import os
import signal

from exercises.grader.sandbox import kernel, limits, seccomp

INBOX, OUTBOX = 3, 4


def arrange_pipes(inbox, outbox, kept=()):
    """The two pipes under known numbers, nothing at 0, 1 and 2, and no other open file."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    wanted = (nowhere, nowhere, nowhere, inbox, outbox)
    copies = [
        fcntl.fcntl(number, fcntl.F_DUPFD, 64) for number in wanted
    ]  # out of the way of what they replace
    for number, copy in enumerate(copies):
        os.dup2(copy, number)
    first = OUTBOX + 1
    for number in sorted(kept):
        os.closerange(first, number)
        first = number + 1
    os.closerange(first, 4096)


def shut_in(box):
    """`box` is what the parent was told of the machine: see parent.py."""
    user = box["user"]
    private = box["private_scratch"] and mount_scratch(box["scratch"], box["limits"].scratch, user)
    if box["private_scratch"] and not private:
        raise OSError("no scratch folder of its own could be mounted")
    os.chdir(box["scratch"])
    if user is not None:
        become(user)
    limits.confine(box["limits"], box["loaded"], box["processes"])
    if box["ruleset"] is not None:
        box["ruleset"].confine()
        os.close(box["ruleset"].number)
    kernel.prctl(kernel.PR_SET_NO_NEW_PRIVS, 1)
    if user is None:
        kernel.keep_only()
    kernel.prctl(kernel.PR_SET_PDEATHSIG, signal.SIGKILL)  # last: a change of user takes it back
    seccomp.confine(os.getpid(), not box["private_scratch"])


def mount_scratch(folder, size, user):
    """A small folder in memory that only this process sees, and that goes with it. True if that worked."""
    try:
        try:
            kernel.unshare(kernel.CLONE_NEWNS)
        except OSError:
            _own_user_namespace()
        with contextlib.suppress(OSError):
            kernel.mount(None, "/", None, kernel.MS_REC | kernel.MS_PRIVATE)
        _close_parent_folder(folder)
        owner = f",uid={user},gid={user}" if user is not None else ""
        options = f"size={size},nr_inodes=4096,mode=0700{owner}"
        flags = kernel.MS_NOSUID | kernel.MS_NODEV | kernel.MS_NOEXEC
        kernel.mount("tmpfs", folder, "tmpfs", flags, options)
        return True
    except OSError:
        return False


def _close_parent_folder(folder):
    """What lies around the scratch folder is read-only for this process, whatever Landlock lets it do
    there."""
    around = os.path.dirname(folder)
    if around != "/":
        kernel.mount(around, around, None, kernel.MS_BIND)
        flags = kernel.MS_BIND | kernel.MS_REMOUNT | kernel.MS_RDONLY | kernel.MS_NOSUID | kernel.MS_NODEV
        kernel.mount(None, around, None, flags)


def _own_user_namespace():
    user, group = os.getuid(), os.getgid()
    kernel.unshare(kernel.CLONE_NEWUSER | kernel.CLONE_NEWNS)
    for name, text in (
        ("setgroups", "deny"),
        ("uid_map", f"{user} {user} 1"),
        ("gid_map", f"{group} {group} 1"),
    ):
        with open(f"/proc/self/{name}", "w") as file:
            file.write(text)


def become(user):
    """From root to a user whom nobody else is. What Landlock or bubblewrap lets it see, it may read, wherever
    the interpreter is installed."""
    kernel.prctl(kernel.PR_SET_KEEPCAPS, 1)
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    try:
        kernel.keep_only(kernel.CAP_DAC_READ_SEARCH)
    except OSError:  # a container's root may not have it
        kernel.keep_only()
