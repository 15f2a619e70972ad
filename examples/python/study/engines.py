"""A million touchdowns by `dask.distributed` and by Ray, on the cores of this machine, with a worker killed (signal 9)
when a third is done; the results must be the serial ones, bit for bit.

    pip install . scipy distributed ray
    python study/engines.py --runs 1000000 --kill serial dask ray
    python study/engines.py --workers 1 2 -- dask ray             # what another worker brings
"""

import argparse
import hashlib
import os
import signal
import sys
import time

import lander
import numpy as np

#: Threads of a worker, which has one core.
ONE_CORE = {"RAYON_NUM_THREADS": "1"}


def chunks(runs, size):
    """Pairs of the first run of a chunk and the one after its last."""
    return [(start, min(start + size, runs)) for start in range(0, runs, size)]


def work(seed, start, stop, log=None, dies_at=None):
    """What a worker does: who it is, and its results.

    For tests, on one disk: `log` notes who begins which chunk, and who first makes the one at `dies_at` is killed
    before it hands over the results.
    """
    again = True
    if log is not None:
        with open(log, "a+") as file:
            file.seek(0)
            again = any(line.split()[0] == str(start) for line in file)
            file.write(f"{start} {os.getpid()}\n")
    rows = lander.touchdowns(seed, start, stop)
    if start == dies_at and not again:
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid(), rows


class Killer:
    """Kills the worker that gave the latest results, when a third of them is there: it is at work on the next."""

    def __init__(self, count, armed):
        self.left = max(count // 3, 1) if armed else None
        self.killed = None

    def __call__(self, pid):
        if self.left is None:
            return
        self.left -= 1
        if self.left == 0:
            os.kill(pid, signal.SIGKILL)
            self.left, self.killed = None, pid


def serial(seed, runs, size, workers=1, kill=False, log=None, dies_at=None):
    """Chunk by chunk in this process, on as many threads as `RAYON_NUM_THREADS` says."""
    return np.concatenate([work(seed, start, stop)[1] for start, stop in chunks(runs, size)]), None


def dask(seed, runs, size, workers=2, kill=False, log=None, dies_at=None):
    """By `dask.distributed`. The scheduler gives what a lost worker had, done or not, to the others."""
    from distributed import Client, LocalCluster, as_completed

    # Another cluster takes these two lines in place of the next two, and `scenes` installed on its nodes:
    #     cluster = client = Client("tcp://scheduler:8786")
    #     client.upload_file("lander.py")
    cluster = LocalCluster(n_workers=workers, threads_per_worker=1, env=ONE_CORE, dashboard_address=None)
    client = Client(cluster)
    parts, results = chunks(runs, size), {}
    killer = Killer(len(parts), kill)
    with cluster, client:
        started = {client.submit(work, seed, *part, log, dies_at, pure=False): part for part in parts}
        for future, (pid, rows) in as_completed(started, with_results=True):
            results[started[future]] = rows
            future.release()
            killer(pid)
    return np.concatenate([results[part] for part in parts]), killer.killed


def ray(seed, runs, size, workers=2, kill=False, log=None, dies_at=None):
    """By Ray. A task whose worker is lost is given to another."""
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    import ray as library

    # Another cluster takes these two lines in place of the next two, and `scenes` installed on its nodes:
    #     there = {"working_dir": os.path.dirname(os.path.abspath(__file__)), "env_vars": ONE_CORE}
    #     library.init("ray://head:10001", runtime_env=there)
    there = {"env_vars": ONE_CORE | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}}
    library.init(num_cpus=workers, include_dashboard=False, runtime_env=there, logging_level="warning")
    parts, results = chunks(runs, size), {}
    killer = Killer(len(parts), kill)
    try:
        task = library.remote(num_cpus=1, max_retries=3)(work)
        started = {task.remote(seed, *part, log, dies_at): part for part in parts}
        waiting = list(started)
        while waiting:
            (done,), waiting = library.wait(waiting, num_returns=1)
            pid, rows = library.get(done)
            results[started.pop(done)] = np.array(rows)
            del done, rows
            killer(pid)
    finally:
        library.shutdown()
    return np.concatenate([results[part] for part in parts]), killer.killed


ENGINES = {"serial": serial, "dask": dask, "ray": ray}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("engines", nargs="*", default=["serial", "dask"], metavar="ENGINE", help="serial, dask, ray")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--runs", type=int, default=20_000)
    parser.add_argument("--chunk", type=int, default=2000, help="runs of one task")
    parser.add_argument("--workers", type=int, nargs="+", default=[2], metavar="N", help="once with each number of them")
    parser.add_argument("--kill", action="store_true", help="one worker, when a third is done")
    given = parser.parse_args()
    if unknown := set(given.engines) - set(ENGINES):
        parser.error(f"there are {', '.join(ENGINES)}, not {', '.join(unknown)}")
    first = None
    asked = [(name, n) for name in given.engines for n in ([1] if name == "serial" else given.workers)]
    for name, workers in asked:
        begin = time.perf_counter()
        rows, killed = ENGINES[name](given.seed, given.runs, given.chunk, workers, given.kill)
        seconds = time.perf_counter() - begin
        kept = hashlib.sha256(rows.tobytes()).hexdigest()[:16]
        by = "" if name == "serial" else f" by {workers}"
        lost = f", worker {killed} was killed" if killed else ""
        failed = np.isnan(rows[:, 0]).sum()
        print(f"{name}{by}: {len(rows)} runs in {seconds:.1f} s{lost}; bits {kept}, {failed} failed", flush=True)
        first = rows if first is None else first
        if rows.tobytes() != first.tobytes():
            sys.exit(f"{name}{by} has other results than the first")


if __name__ == "__main__":
    main()
