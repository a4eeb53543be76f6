"""The sandbox: a student's code runs in it, and reaches neither answers, nor neighbours, nor the machine.

    grader's side       box         one submission: load its cells, put questions, status and troubles
                        workers     one worker of it, seen from outside
                        nursery     the parent processes of a grader, started and talked to
                        wire        pipes with limits on time and length
                        folder      its folder among the temporary ones
                        files, words   a student's file and words, handled with tongs
                        survey      which files the tools need
                        isolation   which kind of isolation works here, found by trying
                        bubblewrap  the command line of bwrap
    both sides          limits      how much of everything
    inside              parent      runs no student code; forks a worker a question
                        preload     what is loaded before the first fork
                        confine     a worker shuts itself in: privileges, scratch folder, Landlock, seccomp
                        landlock, seccomp, syscalls, kernel    how
                        inside      the worker's loop: parse, run cells, answer once
                        canary      tries to break out

What the grader imports is found here by name, so that the inside needs none of the grader's side.
"""

TASKS = {
    "fingerprint": "exercises.grader.classroom.fingerprint:of_cells"
}  # our own functions, run on a notebook's cells
_HOMES = {
    "Sandbox": "box",
    "Limits": "limits",
    "NoSandbox": "nursery",
    "SandboxError": "nursery",
    "Trouble": "words",
    "clean": "words",
    "close": "nursery",
    "probe": "isolation",
}


def __getattr__(name):
    if name not in _HOMES:
        raise AttributeError(name)
    import importlib

    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
