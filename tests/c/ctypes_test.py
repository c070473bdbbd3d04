# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""ctypes_test.py LIBRARY MODELS: the C interface as another language sees it, one file loaded, structs declared anew."""
import ctypes as C
import math
import pathlib
import sys
import threading
import unittest

LIBRARY, MODELS = C.CDLL(sys.argv[1]), pathlib.Path(sys.argv[2])


class Sized(C.Structure):
    def __init__(self, *arguments, **members):
        super().__init__(*arguments, **members)
        self.size = C.sizeof(self)


class Error(Sized):
    _fields_ = [("size", C.c_uint32), ("code", C.c_int32), ("message", C.c_char * 504)]


class Pose(C.Structure):
    _fields_ = [("rotation", C.c_double * 9), ("translation", C.c_double * 3)]


class Seed(C.Structure):
    _fields_ = [("words", C.c_uint64 * 16)]


class Body(Sized):
    _fields_ = [("size", C.c_uint32), ("kind", C.c_int32), ("radius", C.c_double), ("points", C.c_double * 3 * 3),
                ("model", C.c_void_p), ("mesh", C.c_void_p)]


class Answer(Sized):
    _fields_ = [("size", C.c_uint32), ("status", C.c_int32), ("verdict", C.c_int32), ("is_signed", C.c_int32),
                ("lower", C.c_double), ("upper", C.c_double), ("normal", C.c_double * 3), ("point_a", C.c_double * 3),
                ("point_b", C.c_double * 3), ("feature_a", C.c_uint32), ("feature_b", C.c_uint32), ("level_a", C.c_int32),
                ("level_b", C.c_int32), ("steps", C.c_uint32), ("plane_tests", C.c_uint32), ("radius_a", C.c_double),
                ("radius_b", C.c_double), ("levels_visited", C.c_uint32), ("reserved", C.c_uint32)]


class Pair(Sized):
    _fields_ = [("size", C.c_uint32), ("reserved", C.c_uint32), ("a", C.POINTER(Body)), ("b", C.POINTER(Body)), ("b_in_a", Pose),
                ("seed", C.POINTER(Seed))]


STOP = C.CFUNCTYPE(C.c_int32, C.c_void_p)
TASK = C.CFUNCTYPE(None, C.c_void_p, C.c_size_t)
EXECUTE = C.CFUNCTYPE(None, C.c_size_t, TASK, C.c_void_p, C.c_void_p)


class Run(Sized):
    _fields_ = [("size", C.c_uint32), ("reserved", C.c_uint32), ("executor", C.c_void_p), ("stop", STOP),
                ("stop_data", C.c_void_p)]


def must(function, *arguments):
    """Calls a function that takes an error last."""
    error = Error()
    if function(*arguments, C.byref(error)):
        raise RuntimeError(f"{error.code}: {error.message.decode()}")


def at(x, y, z, turn=0.0):
    c, s = math.cos(turn), math.sin(turn)
    return Pose((c, -s, 0, s, c, 0, 0, 0, 1), (x, y, z))


def distance(a, b, pose, seed=None):
    answer = Answer()
    must(LIBRARY.swiftlet_distance, C.byref(a), C.byref(b), C.byref(pose), seed, None, C.byref(answer))
    return answer


def bits(answer):
    return bytes(answer)


class FromAnotherLanguage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bodies = []
        for path in sorted(MODELS.glob("*.swl")):
            model = C.c_void_p()
            must(LIBRARY.swiftlet_model_load, str(path).encode(), None, C.byref(model))
            cls.bodies.append(Body(model=model))
        cls.poses = (Pose * 3000)(*(at(2.5 + 0.0003 * i, 0.1, -0.2, 0.002 * i) for i in range(3000)))

    @classmethod
    def tearDownClass(cls):
        for body in cls.bodies:
            LIBRARY.swiftlet_model_release(C.c_void_p(body.model))

    def batch(self, **how):
        answers = (Answer * len(self.poses))()
        answers[0].size = C.sizeof(Answer)
        run = Run(**how)
        must(LIBRARY.swiftlet_distance_poses, C.byref(self.bodies[0]), C.byref(self.bodies[1]), self.poses,
             C.c_size_t(len(self.poses)), None, C.byref(run), answers)
        return answers

    def test_one_file_says_its_version(self):
        LIBRARY.swiftlet_version.restype = C.c_char_p
        self.assertRegex(LIBRARY.swiftlet_version().decode(), r"^\d+\.\d+\.\d+$")

    def test_a_ball_and_a_box(self):
        box = Body(kind=4, points=((-1, -1, -1), (1, 1, 1)))
        ball = Body(kind=1, radius=0.5)
        apart = distance(box, ball, at(3, 0, 0))
        self.assertEqual((apart.status, apart.verdict, tuple(apart.normal)), (1, 1, (1, 0, 0)))
        self.assertAlmostEqual(apart.lower, 1.5, delta=1e-13)
        inside = Answer()
        must(LIBRARY.swiftlet_signed_distance, C.byref(box), C.byref(ball), C.byref(at(0.75, 0, 0)), None, None, C.byref(inside))
        self.assertAlmostEqual(inside.upper, -0.75, delta=1e-13)

    def test_rotations_are_row_by_row(self):
        bar = Body(kind=2, points=((0, 0, 0), (1, 0, 0)))
        origin = Body(kind=1)
        turned = distance(origin, bar, at(0, -2, 0, math.pi / 2))  # its end is at (0, -1, 0)
        self.assertAlmostEqual(turned.lower, 1, delta=1e-13)

    def test_errors_have_words(self):
        with self.assertRaisesRegex(RuntimeError, "1: .*nowhere"):
            must(LIBRARY.swiftlet_model_load, b"nowhere", None, C.byref(C.c_void_p()))
        with self.assertRaisesRegex(RuntimeError, "100: a is null"):
            must(LIBRARY.swiftlet_distance, None, None, None, None, None, C.byref(Answer()))

    def test_batches_are_single_queries(self):
        answers = self.batch()
        seed = Seed()
        for i in range(1024):
            self.assertEqual(bits(answers[i]), bits(distance(self.bodies[0], self.bodies[1], self.poses[i], C.byref(seed))), i)
        pairs = (Pair * 100)()
        for i, pair in enumerate(pairs):
            pair.size, pair.b_in_a = C.sizeof(Pair), self.poses[i]
            pair.a, pair.b = C.pointer(self.bodies[i % 4]), C.pointer(self.bodies[i // 4 % 4])
        cold = (Answer * 100)()
        cold[0].size = C.sizeof(Answer)
        must(LIBRARY.swiftlet_distance_pairs, pairs, C.c_size_t(100), None, None, cold)
        for i in range(100):
            self.assertEqual(bits(cold[i]), bits(distance(self.bodies[i % 4], self.bodies[i // 4 % 4], self.poses[i])), i)

    def test_threads_of_the_librarys_and_of_pythons(self):
        wanted = bits(self.batch())
        executor = C.c_void_p()
        must(LIBRARY.swiftlet_executor_on_threads, C.c_uint32(3), C.byref(executor))
        self.assertEqual(bits(self.batch(executor=executor)), wanted)
        LIBRARY.swiftlet_executor_release(executor)
        got, threads = {}, []
        for k in range(4):
            threads.append(threading.Thread(target=lambda k=k: got.__setitem__(k, bits(self.batch()))))
            threads[-1].start()
        for thread in threads:
            thread.join()
        self.assertEqual(list(got.values()), [wanted] * 4)

    def test_an_executor_and_a_stop_of_pythons(self):
        def execute(count, task, context, data):
            for i in reversed(range(count)):
                thread = threading.Thread(target=task, args=(context, i))
                thread.start()
                thread.join()
        kept, executor = EXECUTE(execute), C.c_void_p()
        must(LIBRARY.swiftlet_executor_create, kept, None, C.byref(executor))
        self.assertEqual(bits(self.batch(executor=executor)), bits(self.batch()))
        LIBRARY.swiftlet_executor_release(executor)
        with self.assertRaisesRegex(RuntimeError, "11: stopped"):
            self.batch(stop=STOP(lambda data: 1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
