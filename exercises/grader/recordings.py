"""What an engine answered, kept for where it is not installed.

    python -m exercises.grader.recordings --unit 02       re-records, with the engines installed here

An `EngineOracle` is an oracle for `judges.equal`. Where the engine can be imported it runs, else the
committed recording speaks, and of what is not in it a formula of ours, `model`, which the tests hold against
the engine. So every case can be judged anywhere; and since hidden cases are drawn anew, to know the
recordings by heart earns nothing.
"""

import argparse
import contextlib
import json
import os
import platform
import sys
from functools import cache, cached_property
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from exercises.grader.check import Unrecorded


class EngineOracle:
    """`run(**inputs)` asks the engine, `inputs()` lists what to record, `settings` say how it is set;
    `model(inputs)` is what the engine would say, if there is a formula for it."""

    remembers = True  # what it answered, for the engine and for its recording apart

    def __init__(self, engine, path, run, inputs, settings, model=None):
        self.engine, self.path, self.settings = engine, Path(path), settings
        self.run, self.inputs, self.model, self.answers = run, inputs, model, {}

    @property
    def live(self):
        """EXERCISES_ENGINES=recorded makes every machine like one without engines."""
        return os.environ.get("EXERCISES_ENGINES") != "recorded" and find_spec(self.engine) is not None

    @cached_property
    def recording(self):
        return json.loads(self.path.read_text(encoding="utf-8"))

    @property
    def pool(self):
        """The recorded inputs."""
        return [_read(entry["inputs"]) for entry in self.recording["cases"]]

    def __call__(self, values):
        key = self.key(values), self.live
        if key not in self.answers:
            self.answers[key] = self.run(**values) if self.live else self._without_engine(values, key[0])
        return self.answers[key]

    def _without_engine(self, values, key):
        try:
            return self.recorded(key)
        except Unrecorded:
            if self.model is None:
                raise
            return self.model(values)

    @staticmethod
    def key(values):
        return json.dumps(_plain(values))

    def recorded(self, key):
        for entry in self.recording["cases"]:
            if json.dumps(entry["inputs"]) == key:
                return _read(entry["output"])
        raise Unrecorded(
            f"{self.engine} is not installed here, and {self.path.name} does not hold this case: "
            f"check with the usual seed's pool of cases, or where {self.engine} is installed"
        )

    def source(self):
        """Which of the two speaks, in words."""
        if self.live:
            return f"{self.engine} {_version(self.engine)}, run live"
        made = self.recording
        words = f"a recording of {made['engine']} {made['version']} made on {made['platform']}"
        return words if self.model is None else f"{words}, and a formula that agrees with it"

    def record(self):
        """Runs the engine on all inputs, and writes the recording."""
        cases = [{"inputs": _plain(values), "output": _plain(self.run(**values))} for values in self.inputs()]
        head = {
            "engine": self.engine,
            "version": _version(self.engine),
            "settings": self.settings,
            "platform": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
        }
        lines = ",\n".join("  " + json.dumps(case) for case in cases)
        text = json.dumps(head, indent=1)[:-2] + ',\n "cases": [\n' + lines + "\n ]\n}\n"
        self.path.write_text(text, encoding="utf-8")


@contextlib.contextmanager
def silence():
    """Nothing reaches the terminal, not even from compiled code: some engines announce themselves when
    imported."""
    sys.stderr.flush()
    nowhere, kept = os.open(os.devnull, os.O_WRONLY), [(number, os.dup(number)) for number in (1, 2)]
    try:
        for number, _ in kept:
            os.dup2(nowhere, number)
        yield
    finally:
        for number, copy in kept:
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)


@cache
def _version(engine):
    """Looked up on disk once, not for each submission."""
    return version(engine)


def _plain(value):
    """As JSON that can be read and compared by eye; floats are written so that they return exactly."""
    if isinstance(value, np.ndarray):
        return {"array": value.tolist()}
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, (tuple, list)) else value


def _read(data):
    if isinstance(data, dict):
        return (
            np.array(data["array"]) if "array" in data else {key: _read(item) for key, item in data.items()}
        )
    return tuple(_read(item) for item in data) if isinstance(data, list) else data


def main(arguments=None):
    import exercises

    parser = argparse.ArgumentParser(
        prog="python -m exercises.grader.recordings", description="Re-records a unit."
    )
    parser.add_argument("--unit", required=True)
    unit = exercises.slug(parser.parse_args(arguments).unit)
    for oracle in exercises.part(unit, "engines").ENGINES:
        oracle.record()
        print(f"recorded {len(oracle.recording['cases'])} cases of {oracle.engine} in {oracle.path.name}")


if __name__ == "__main__":
    sys.exit(main())
