"""The in-sandbox parent. It runs no student code and reads nothing of a student's: a worker's pipes come from
the grader and go to the worker. So a fork of it holds nothing of a neighbour's either.

Over a socket (fd given as argument) come, one message each:

    {"start": {...}}                                     → {"ready": true} once all is loaded
    {"spawn": {limits}}  with two open files: inbox, outbox     → {"pid": n}
    {"end": pid}                                         → {"code": ..., "cpu": seconds}
"""

import json
import os
import resource
import signal
import socket
import sys

MESSAGE = 1 << 20


class Parent:
    def __init__(self, link):
        self.link, self.machine, self.alive = link, None, {}

    def serve(self):
        """Until the grader goes."""
        while True:
            self.link.settimeout(0.2 if self.alive and self.watches() else None)
            try:
                text, files, *_ = socket.recv_fds(self.link, MESSAGE, 2)
            except TimeoutError:
                self.watch_scratch()
                continue
            if not text:
                return
            message = json.loads(text)
            try:
                answer = getattr(self, next(iter(message)))(next(iter(message.values())), files)
            except OSError as error:
                answer = {"error": str(error)}
            finally:
                for number in files:
                    os.close(number)
            self.link.sendall(json.dumps(answer).encode())

    def start(self, machine, files):
        from exercises.grader.sandbox import preload

        preload.load(machine["tools"])
        if machine["landlock"]:
            from exercises.grader.sandbox import landlock

            scratch = machine["scratch"]
            if machine[
                "private_scratch"
            ]:  # the rule of a folder that is mounted over counts no more: its parent's
                writable = {os.path.dirname(scratch): landlock.PRIVATE}
            else:
                writable = {scratch: landlock.FLAT}
            writable["/dev/null"] = landlock.READ_FILE | landlock.WRITE_FILE
            machine["ruleset"] = landlock.Ruleset(machine["readable"], machine["listable"], writable)
        else:
            machine["ruleset"] = None
        if machine["confined"]:
            from exercises.grader.sandbox import kernel, seccomp

            kernel.drop_bounds()  # no capability comes back to a worker
            seccomp.prepare(not machine["private_scratch"])
        preload.settle()
        self.machine = machine
        self.wipe_scratch()  # of what libraries wrote while they were loaded
        return {"ready": True}

    def spawn(self, limits, files):
        pid = os.fork()
        if pid == 0:
            self.become_worker(limits, *files)
        self.alive[pid] = limits["scratch"]
        return {"pid": pid}

    def become_worker(self, given_limits, inbox, outbox):
        """In the fork. Does not return."""
        code = 70
        try:
            from exercises.grader.sandbox import confine
            from exercises.grader.sandbox.inside import Inside
            from exercises.grader.sandbox.limits import Limits

            ruleset = self.machine["ruleset"]
            self.link.close()
            confine.arrange_pipes(inbox, outbox, [ruleset.number] if ruleset else [])
            try:
                if self.machine["confined"]:
                    confine.shut_in({**self.machine, "limits": Limits(**given_limits)})
                else:
                    os.chdir(self.machine["scratch"])
            except OSError as error:
                os.write(confine.OUTBOX, json.dumps({"unconfined": str(error)}).encode() + b"\n")
                os._exit(71)
            sys.stdin, sys.stdout, sys.stderr = map(_text_file, (0, 1, 2), "rww")
            Inside(confine.INBOX, confine.OUTBOX).serve()
            code = 0
        except BaseException:  # a student's SystemExit in a thread, MemoryError ...: the worker ends, no more
            pass
        finally:
            os._exit(code)

    def end(self, pid, files):
        """Kills the worker if it still lives. Its whole process group goes: it has no other."""
        if pid not in self.alive:
            return {"error": f"there is no worker {pid}"}
        os.kill(pid, signal.SIGKILL)
        before = _children_cpu()
        _, status = os.waitpid(pid, 0)
        cpu = _children_cpu() - before
        del self.alive[pid]
        self.wipe_scratch()
        return {"code": os.waitstatus_to_exitcode(status), "cpu": cpu}

    # --- a scratch folder on disk, where none can be mounted: flat, watched, wiped after each worker --------

    def watches(self):
        return not self.machine["private_scratch"] and self.machine["confined"]

    def watch_scratch(self):
        files = [entry.stat(follow_symlinks=False) for entry in os.scandir(self.machine["scratch"])]
        if sum(item.st_blocks * 512 + 4096 for item in files) > max(self.alive.values()):
            for pid in self.alive:
                os.kill(pid, signal.SIGKILL)

    def wipe_scratch(self):
        for entry in os.scandir(self.machine["scratch"]):
            if entry.is_file(follow_symlinks=False):
                os.unlink(entry.path)


def _children_cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def _text_file(number, mode):
    return open(number, mode, encoding="utf-8", errors="replace")


def main(number):
    link = socket.socket(fileno=number)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the grader's to handle
    parent = Parent(link)
    try:
        parent.serve()
    finally:
        for pid in parent.alive:
            os.kill(pid, signal.SIGKILL)
        for pid in parent.alive:
            os.waitpid(pid, 0)  # whoever waits for the parent finds no worker any more


if __name__ == "__main__":
    main(int(sys.argv[1]))
