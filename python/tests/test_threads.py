# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Threads, processes and signals around a batch."""

import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import CORNERS, MODELS, SIDES, orbit, random_poses, same, shift

import swiftlet
from swiftlet.scene import Scene


def test_the_interpreter_goes_on_while_a_batch_runs(fat):
    poses, ticks, done = np.tile(orbit(2000), (150, 1, 1)), 0, threading.Event()
    thread = threading.Thread(target=lambda: (swiftlet.distance(*fat, poses), done.set()))
    thread.start()
    while not done.is_set():
        ticks += 1
    thread.join()
    assert ticks > 1000


def test_a_model_may_go_while_others_ask():
    expected = swiftlet.distance(swiftlet.Model.from_arrays(CORNERS, SIDES), swiftlet.Body.point([0, 0, 0]), orbit(60000, 3))
    results, poses = [], orbit(60000, 3)
    models = [swiftlet.Model.from_arrays(CORNERS, SIDES) for _ in range(4)]
    threads = [
        threading.Thread(
            target=lambda m: results.append(swiftlet.distance(m, swiftlet.Body.point([0, 0, 0]), poses, threads=2)), args=(m,)
        )
        for m in models
    ]
    for t in threads:
        t.start()
    del models, t
    gc.collect()
    junk = [bytearray(100000) for _ in range(200)]  # takes what was freed
    for thread in threads:
        thread.join()
    assert len(results) == 4 and all(same(r, expected) for r in results) and junk


def test_seeds_are_one_calls_at_a_time(fat):
    seeds, poses, raised = swiftlet.Seeds(300000), np.tile(orbit(3000), (100, 1, 1)), []
    barrier = threading.Barrier(2)

    def ask():
        barrier.wait()
        try:
            swiftlet.distance(*fat, poses, seeds=seeds)
        except RuntimeError as error:
            raised.append(str(error))

    threads = [threading.Thread(target=ask) for _ in range(2)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert raised == ["seeds: another call is using them; give each its own"]


def ask_in_child(connection):
    bodies = swiftlet.Model.load(MODELS / "fat_a.swl"), swiftlet.Model.load(MODELS / "fat_b.swl")
    connection.send(swiftlet.distance(*bodies, orbit(5000), threads=4).records)
    connection.close()


@pytest.mark.parametrize("while_asking", [False, True])
def test_a_fork_after_threads_works(fat, while_asking):
    expected = swiftlet.distance(*fat, orbit(5000), threads=4)
    stop, asking = threading.Event(), None
    if while_asking:
        asking = threading.Thread(
            target=lambda: [swiftlet.distance(*fat, orbit(5000), threads=2) for _ in iter(stop.is_set, True)]
        )
        asking.start()
    ours, theirs = multiprocessing.get_context("fork").Pipe(False)
    child = multiprocessing.get_context("fork").Process(target=ask_in_child, args=(theirs,))
    child.start()
    try:
        assert ours.poll(60), "the child hangs"
        assert same(expected, swiftlet.Answers(ours.recv()))
    finally:
        child.join(10)
        child.kill()
        stop.set()
        if asking:
            asking.join()


LONG = """
import sys, time, numpy as np, swiftlet
a, b = swiftlet.Model.load(sys.argv[1]), swiftlet.Model.load(sys.argv[2])
mesh = swiftlet.MeshModel.from_arrays(a.vertices, a.faces)
bodies = (a, b) if sys.argv[3] == "hulls" else (mesh, mesh)
poses = np.tile(np.eye(4), (6_000_000 if sys.argv[3] == "hulls" else 1_500_000, 1, 1))
poses[:, 0, 3] = 2.2 + 0.1 * np.sin(np.arange(len(poses)))
seeds = swiftlet.Seeds(len(poses)) if sys.argv[5] == "seeds" else None
print("ready", flush=True)
try:
    swiftlet.distance(*bodies, poses, threads=int(sys.argv[4]), seeds=seeds)
    print("not interrupted", flush=True)
except KeyboardInterrupt:
    print(time.monotonic(), flush=True)
again = swiftlet.distance(*bodies, poses[:3000], threads=2)
print(len(again), (again.status == swiftlet.Status.CONVERGED).all(), flush=True)
"""


@pytest.mark.parametrize(
    "bodies, threads, seeds", [("hulls", 1, ""), ("hulls", 2, ""), ("meshes", 2, ""), ("hulls", 2, "seeds")]
)
def test_ctrl_c_stops_a_batch_within_100_ms(bodies, threads, seeds):
    command = [sys.executable, "-c", LONG, MODELS / "fat_a.swl", MODELS / "fat_b.swl", bodies, str(threads), seeds]
    took = []
    for _ in range(3):  # a machine under load may be late once
        child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.25)
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        out, _ = child.communicate(timeout=60)
        lines = out.splitlines()
        assert lines[1] == "3000 True" and child.returncode == 0, out
        took.append(float(lines[0]) - sent)
        if took[-1] < 0.1:
            return
    raise AssertionError(f"stopped after {took} s")


def test_a_handler_that_returns_lets_the_batch_go_on(fat):
    poses, seen = np.tile(orbit(2000), (150, 1, 1)), []
    before = signal.signal(signal.SIGALRM, lambda *_: seen.append(time.monotonic()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.01)
        answers = swiftlet.distance(*fat, poses, threads=2)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert seen and same(answers[:2000][:1024], swiftlet.distance(*fat, poses[:1024]))


def test_a_handler_that_forks_is_told_so(fat):
    poses, in_child = np.tile(orbit(2000), (150, 1, 1)), []

    def fork(*_):
        if os.fork() == 0:
            in_child.append(True)

    before = signal.signal(signal.SIGALRM, fork)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.01)
        answers = swiftlet.distance(*fat, poses, threads=2)
    except RuntimeError as error:
        os._exit(7 if in_child and "forked" in str(error) else 1)
    finally:
        signal.signal(signal.SIGALRM, before)
        if in_child:
            os._exit(2)
    assert os.waitstatus_to_exitcode(os.wait()[1]) == 7 and len(answers) == len(poses)


def test_a_pair_is_asked_by_threads(mesh):
    pair = swiftlet.Pair(mesh, mesh)
    poses = random_poses(300, 4)
    expected = swiftlet.distance(mesh, mesh, poses).value
    wrong = []

    def ask():
        wrong.extend(i for i, pose in enumerate(poses) if abs(pair.distance(pose).value - expected[i]) > 1e-12)

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert not wrong


def test_a_scene_is_asked_by_threads():
    scene = Scene(threads=2)
    box = swiftlet.Body.box([-1, -1, -1], [1, 1, 1])
    ids = [scene.add(f"{k}", box, shift(1.5 * k)) for k in range(20)]

    def ask():
        for _ in range(50):
            assert len(scene.overlapping()[2]) == 19
            scene.move(ids[0], shift(0))

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(scene) == 20


@pytest.mark.parametrize("several", [False, True])
def test_ctrl_c_ends_a_wait_for_a_scene(several):
    scene, other, asked, leave = Scene(), Scene(), threading.Event(), threading.Event()
    box = swiftlet.Body.box([-1, -1, -1], [1, 1, 1])
    for k in range(2):
        scene.add(f"{k}", box, shift(k))
    scene.ask_only(lambda a, b: (asked.set(), leave.wait(60))[1])
    thread = threading.Thread(target=scene.overlapping)
    thread.start()
    assert asked.wait(60)

    def alarm(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, alarm)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        began = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            other.overlapping(scene) if several else len(scene)
        assert time.monotonic() - began < 30
    finally:
        signal.signal(signal.SIGALRM, before)
        leave.set()
        thread.join()
    assert len(scene) == 2 and len(other) == 0 and len(other.overlapping(scene)[2]) == 0


DAEMON = """
import sys, threading
import numpy as np
import swiftlet
from swiftlet.scene import Scene

model, asked, never = swiftlet.Model.load(sys.argv[1]), threading.Event(), threading.Event()
poses = np.tile(np.eye(4), (3_000_000, 1, 1))
poses[:, 0, 3] = 3
scene = Scene()
for name in "ab":
    scene.add(name, model, np.eye(4))
scene.ask_only(lambda a, b: (asked.set(), never.wait()))
threading.Thread(target=scene.overlapping, daemon=True).start()
asked.wait()
threading.Thread(target=lambda: len(scene), daemon=True).start()
for threads in (1, 2):
    threading.Thread(target=lambda n: swiftlet.distance(model, model, poses, threads=n), args=(threads,), daemon=True).start()
never.wait(0.1)
"""


def test_the_interpreter_ends_while_daemons_wait_and_ask():
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", DAEMON, MODELS / "fat_a.swl"], capture_output=True, text=True, timeout=120)
        assert ended.returncode == 0, ended.stderr


def test_functions_that_wait_for_each_other_are_told_so():
    box = swiftlet.Body.box([-1, -1, -1], [1, 1, 1])
    scenes, barrier, ended = [Scene() for _ in range(3)], threading.Barrier(3), []
    for scene in scenes:
        for k in range(2):
            scene.add(f"{k}", box, shift(k))
    for k in range(3):
        scenes[k].ask_only(lambda a, b, other=scenes[(k + 1) % 3]: barrier.wait(60) is not None and len(other) > 0)

    def ask(scene):
        try:
            ended.append(len(scene.overlapping()[2]))
        except RuntimeError as error:
            ended.append(str(error))

    threads = [threading.Thread(target=ask, args=(scene,), daemon=True) for scene in scenes]
    for t in threads:
        t.start()
    for t in threads:
        t.join(60)
    refused = [e for e in ended if e != 1]
    assert len(ended) == 3 and len(refused) == 1 and "neither can go on" in refused[0]


def test_scenes_are_asked_about_each_other_by_threads():
    box = swiftlet.Body.box([-1, -1, -1], [1, 1, 1])
    scenes = [Scene() for _ in range(3)]
    for k, scene in enumerate(scenes):
        scene.add("a", box, shift(k))
    found = []

    def ask(one, other):
        for _ in range(300):
            found.append(len(scenes[one].overlapping(scenes[other])[2]))

    threads = [threading.Thread(target=ask, args=pair) for pair in ((0, 1), (1, 0), (1, 2), (2, 1), (0, 2), (2, 0))]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert found == [1] * 1800
