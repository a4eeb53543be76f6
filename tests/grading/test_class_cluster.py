"""A real Dask cluster: a scheduler and two workers, one of them killed half way."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

import exercises
from exercises.grader.classroom import cluster as class_cluster
from exercises.grader.classroom.files import Trouble
from reference import bench, cluster
from tests.grading.class_support import UNIT, grade, plant, solution

ROOT = exercises.FOLDER.parent


@pytest.mark.parametrize(
    "address",
    [
        "tcp://127.0.0.1:8786",
        "tcp://localhost:8786",
        "tcp://[::1]:8786",
        "tls://cluster.example:8786",
    ],
)
def test_safe_addresses(address):
    cluster.require_safe(address)


@pytest.mark.parametrize(
    "address",
    [
        "tcp://10.0.0.5:8786",
        "tcp://cluster.example:8786",
        "127.0.0.1:8786",
        "ws://127.0.0.1:8786",
        "tcp://127.0.0.1.evil.example:8786",
        "tcp://127.0.0.1:8786@evil:1",
        "",
        "tls://",
    ],
)
def test_unsafe_addresses(address):
    with pytest.raises(cluster.ClusterError):
        cluster.require_safe(address)


@pytest.fixture
def processes():
    """Starts Dask's programs, and ends them."""
    started = []
    environment = dict(os.environ, PYTHONPATH=str(ROOT), DASK_DISTRIBUTED__ADMIN__TICK__LIMIT="60s")

    def start(*command):
        started.append(
            subprocess.Popen(
                [sys.executable, "-m", "distributed.cli." + command[0], *command[1:]],
                cwd=ROOT,
                env=environment,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        )
        return started[-1]

    yield start
    for process in reversed(started):
        for number in (signal.SIGTERM, signal.SIGKILL):
            if process.poll() is None:
                os.killpg(process.pid, number)
                try:
                    process.wait(10)
                except subprocess.TimeoutExpired:
                    continue


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.mark.slow
def test_a_killed_worker_loses_nothing(tmp_path, processes, monkeypatch):
    plant(tmp_path, {f"student{i:02}": solution(i % 2) for i in range(16)})
    port = free_port()
    address = f"tcp://127.0.0.1:{port}"
    processes("dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
    options = (address, "--nthreads", "1", "--no-dashboard", "--no-nanny", "--host", "127.0.0.1")
    doomed = processes("dask_worker", *options)
    processes("dask_worker", *options)
    kept, killed = Counter(), []
    text_of = class_cluster._text

    def counting(future):
        kept[future.key] += 1
        if sum(kept.values()) == 6:
            os.killpg(doomed.pid, signal.SIGKILL)
            killed.append(time.monotonic())
        return text_of(future)

    monkeypatch.setattr(class_cluster, "_text", counting)
    monkeypatch.setattr(cluster, "LEAST_WORKERS", 2)
    scores, told = grade(tmp_path, scheduler=address)
    assert killed and "2 workers" in told
    assert len(kept) == 16 and set(kept.values()) == {1}
    assert {score.status for score in scores.values()} == {"ok"} and len(scores) == 16
    assert all(score.final == 100 for score in scores.values())
    assert len(list((tmp_path / "instructor/results" / UNIT.slug).iterdir())) == 16
    assert not (tmp_path / "instructor/history.jsonl").exists()  # no result was written twice


def test_a_scheduler_that_is_not_there(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with pytest.raises(Trouble, match="does not answer"):
        next(class_cluster.run(iter([("a", "{}")]), f"tcp://127.0.0.1:{free_port()}"))


def test_dask_is_pinned():
    pins = (Path(ROOT) / "environment.txt").read_text(encoding="utf-8")
    assert "\ndistributed==" in pins and "\ndask==" in pins


@pytest.mark.slow
def test_the_benchmark_on_a_cluster(tmp_path, processes):
    port = free_port()
    address = f"tcp://127.0.0.1:{port}"
    processes("dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
    processes("dask_worker", address, "--nthreads", "1", "--no-dashboard", "--no-nanny")
    bench.main(["free_fall", "spring", "--quick", "--out", str(tmp_path), "--scheduler", address])
    rows = [json.loads(line) for line in (tmp_path / "bench.jsonl").read_text(encoding="utf-8").splitlines()]
    assert {"free_fall", "spring"} <= {row["case"].split("/")[0] for row in rows}
    assert any(row["status"] == "ok" and row["cpu_s"] > 0 for row in rows)
