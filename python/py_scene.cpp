// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes for Python: each has a lock of its own, which is never waited for while the interpreter's is held. A wait ends by a
// signal, and where threads would wait for each other for ever.
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <swiftlet/scene.h>

#include "arguments.h"
#include "arrays.h"
#include "crew.h"
#include "failure.h"
#include "records.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

struct HeldScene {
  Scene scene;
  unsigned threads = 1;
  std::timed_mutex mutex;
  std::atomic<std::thread::id> owner{};
  py::object asks;            ///< what `ask_only` was given; read and changed with the interpreter's lock
  std::exception_ptr raised;  ///< by it
};

using ScenePointer = std::shared_ptr<HeldScene>;

/// Which scene each thread waits for. A thread that waits within `ask_only`'s function holds another scene meanwhile.
class Waiting {
 public:
  /// Whether the scene could be locked within 10 ms. Throws where its owner waits, in the end, for this thread.
  static bool got(std::unique_lock<std::timed_mutex>& lock, const HeldScene& scene) {
    if (lock.try_lock()) return true;
    const Waiting waiting(scene);
    return lock.try_lock_for(std::chrono::milliseconds(10));
  }

 private:
  explicit Waiting(const HeldScene& scene) {
    const std::lock_guard<std::mutex> guard(mutex_);
    const HeldScene* wanted = &scene;
    // A thread that has just got its scene may still be listed, so that owners may seem to go round without end. What leads to
    // this thread is true: whoever waits for a scene that this one holds waits still.
    for (std::size_t k = 0; wanted && k <= all_.size(); ++k) {
      const std::thread::id owner = wanted->owner;
      if (owner == std::this_thread::get_id())
        throw std::runtime_error("two threads ask each other's scenes within functions of `ask_only`: neither can go on");
      const auto found = all_.find(owner);
      wanted = found == all_.end() ? nullptr : found->second;
    }
    all_[std::this_thread::get_id()] = &scene;
  }
  ~Waiting() {
    const std::lock_guard<std::mutex> guard(mutex_);
    all_.erase(std::this_thread::get_id());
  }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

  static inline std::mutex mutex_;
  static inline auto& all_ = *new std::map<std::thread::id, const HeldScene*>;  // threads may wait when the interpreter ends
};

/// The locks of one scene or two: while it waits for one it does not hold the other.
class Locks {
 public:
  Locks(HeldScene& scene, HeldScene& other, Unlocked& crew) : scene_(scene), other_(other) {
    std::unique_lock<std::timed_mutex> first(scene.mutex, std::defer_lock), second(other.mutex, std::defer_lock);
    const HeldScene *of_first = &scene, *of_second = &other;
    while (!Waiting::got(first, *of_first) || (&scene != &other && !second.try_lock())) {
      if (crew.stopped()) crew.finish();  // raises what a signal's handler did
      if (first) first.unlock(), std::swap(first, second), std::swap(of_first, of_second);
    }
    first.release(), second.release();
    scene.owner = other.owner = std::this_thread::get_id();
  }
  ~Locks() {
    scene_.owner = other_.owner = std::thread::id();
    scene_.mutex.unlock();
    if (&scene_ != &other_) other_.mutex.unlock();
  }
  Locks(const Locks&) = delete;
  Locks& operator=(const Locks&) = delete;

 private:
  HeldScene &scene_, &other_;
};

/// Locks one scene or two without the interpreter's lock, and runs the work without it.
template <class Work>
auto locked(HeldScene& scene, HeldScene& other, Work work) {
  const std::thread::id me = std::this_thread::get_id();
  if (scene.owner == me || other.owner == me)
    throw std::runtime_error("a scene cannot be asked or changed while it asks `ask_only`'s function");
  Unlocked crew(scene.threads);
  const Locks locks(scene, other, crew);
  scene.raised = nullptr;
  scene.scene.run_by({crew.executor(), [&crew] { return crew.stopped(); }});
  auto result = work(scene.scene, other.scene);
  scene.scene.run_by({});
  const std::exception_ptr raised = std::exchange(scene.raised, nullptr);
  crew.finish();
  if (raised) std::rethrow_exception(raised);
  return result;
}
template <class Work>
auto locked(HeldScene& scene, Work work) {
  return locked(scene, scene, [&](Scene& s, Scene&) { return work(s); });
}

using Id = std::pair<std::uint32_t, std::uint32_t>;
BodyId to_id(const Id& id) { return {id.first, id.second}; }
Id from_id(BodyId id) { return {id.index, id.generation}; }

Pose to_pose(py::handle pose, py::handle quaternion) {
  const PoseRows rows(pose, quaternion_order(quaternion), false, "pose");
  if (!rows.is_single()) throw py::value_error("pose: expected one, got " + std::to_string(rows.size()));
  return rows[0];
}

/// Ids of both sides, (n, 2) each, and the records.
template <class Pair>
py::tuple listed(const std::vector<Pair>& pairs) {
  const auto count = py::ssize_t(pairs.size());
  py::array_t<std::uint32_t> a({count, py::ssize_t(2)}), b({count, py::ssize_t(2)});
  const py::array records = new_records(answer_dtype(), pairs.size(), false);
  auto* into = static_cast<Answer*>(const_cast<void*>(records.data()));
  for (py::ssize_t i = 0; i < count; ++i) {
    const Pair& p = pairs[std::size_t(i)];
    a.mutable_at(i, 0) = p.a.index, a.mutable_at(i, 1) = p.a.generation;
    b.mutable_at(i, 0) = p.b.index, b.mutable_at(i, 1) = p.b.generation;
    into[i] = p.answer;
  }
  return py::make_tuple(a, b, records);
}

Options to_options(const Real& absolute, const Real& relative, const Real& beyond, const py::object& steps) {
  Options options;
  options.absolute = to_double(absolute, "absolute"), options.relative = to_double(relative, "relative");
  options.beyond = to_double(beyond, "beyond");
  if (!steps.is_none()) options.budget.steps = to_steps(steps);
  return options;
}

/// Lets Python's collector see what `ask_only` was given, which may refer to the scene.
void collect(PyHeapTypeObject* heap) {
  // None where the object has no scene yet, or no more.
  static constexpr auto scene_of = [](PyObject* self) -> HeldScene* {
    const auto* instance = reinterpret_cast<py::detail::instance*>(self);
    if (!instance->simple_layout || !instance->simple_holder_constructed) return nullptr;
    return static_cast<HeldScene*>(instance->simple_value_holder[0]);
  };
  PyTypeObject& type = heap->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    if (const HeldScene* scene = scene_of(self)) Py_VISIT(scene->asks.ptr());
    return 0;
  };
  type.tp_clear = [](PyObject* self) {
    if (HeldScene* scene = scene_of(self)) scene->asks = py::none();
    return 0;
  };
  type.tp_dealloc = [](PyObject* self) {
    PyObject_GC_UnTrack(self);
    reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base)->tp_dealloc(self);
  };
}

}  // namespace

void define_scenes(py::module_& module) {
  py::class_<HeldScene, ScenePointer> c(
      module, "Scene", R"(Bodies in one world, each with a name, and what is kept of pairs from question to question.

Bodies are named by ids, pairs of an index and a generation that never come back. Poses map a body's frame into the world's. A
question about all pairs leaves out those whose boxes are proved to be farther apart than asked and lists, in the order of ids,
every other one that is not proved to be farther; answers are in A's frame about ``relative(pose(a), pose(b))``. The same calls give the
same bits on any number of threads. Calls of several threads take turns.)",
      py::custom_type_setup(&collect));
  refuse_pickles(c);
  c.def(py::init([](const Whole& threads) {
          auto scene = std::make_shared<HeldScene>();
          scene->threads = to_threads(threads);
          return scene;
        }),
        py::kw_only(), py::arg("threads") = 1);
  c.def(
      "add",
      [](HeldScene& s, const std::string& name, py::handle body, py::handle pose, py::handle quaternion) {
        const OwnedBody b = to_body(body, "body");
        const Pose in_world = to_pose(pose, quaternion);
        const BodyId id = locked(s, [&](Scene& scene) {
          return b.is_mesh() ? scene.add(name, b.body(), in_world) : scene.add(name, b.convex(), in_world);
        });
        if (id == BodyId{}) throw py::value_error("name: there is a body '" + name + "' already");
        return from_id(id);
      },
      py::arg("name"), py::arg("body"), py::arg("in_world"), py::kw_only(), py::arg("quaternion") = py::none(),
      "Adds a body and returns its id; an empty name names nothing. ValueError where another body has the name.");
  c.def(
      "move",
      [](HeldScene& s, const Id& id, py::handle pose, py::handle quaternion) {
        const Pose in_world = to_pose(pose, quaternion);
        return locked(s, [&](Scene& scene) { return scene.move(to_id(id), in_world); });
      },
      py::arg("id"), py::arg("in_world"), py::kw_only(), py::arg("quaternion") = py::none(),
      "Moves a body; False if `id` names none.");
  c.def(
      "remove", [](HeldScene& s, const Id& id) { return locked(s, [&](Scene& scene) { return scene.remove(to_id(id)); }); },
      py::arg("id"), "Removes a body; False if `id` names none.");
  c.def(
      "ask_only",
      [](HeldScene& s, py::object asks) {
        if (!asks.is_none() && !PyCallable_Check(asks.ptr()))
          throw py::type_error("asks: expected a function or None, got " + what_came(asks));
        std::function<bool(BodyId, BodyId)> function;
        if (!asks.is_none()) {
          function = [&s](BodyId a, BodyId b) {
            const py::gil_scoped_acquire acquire;
            if (s.raised) return false;
            try {
              return is_true(s.asks(from_id(a), from_id(b)));
            } catch (...) {
              s.raised = std::current_exception();
              return false;
            }
          };
        }
        locked(s, [&](Scene& scene) {
          scene.ask_only(std::move(function));
          const py::gil_scoped_acquire acquire;
          std::swap(s.asks, asks);
          return 0;
        });
      },
      py::arg("asks"),
      "Pairs within this scene for which ``asks(a, b)`` is false are left out of all answers; a < b are ids. None: all are "
      "asked.\n\n"
      "The function may ask other scenes; to ask or change one of the question that calls it is RuntimeError. So is to "
      "wait\nfor a scene whose question waits, in another thread's function, for this one.");
  c.def(
      "find",
      [](HeldScene& s, const std::string& name) -> py::object {
        const BodyId id = locked(s, [&](Scene& scene) { return scene.find(name); });
        return id == BodyId{} ? py::object(py::none()) : py::cast(from_id(id));
      },
      py::arg("name"), "The id of the body with this name, or None.");
  c.def(
      "has", [](HeldScene& s, const Id& id) { return locked(s, [&](Scene& scene) { return scene.has(to_id(id)); }); },
      py::arg("id"), "Whether `id` names a body of this scene.");
  c.def("__len__", [](HeldScene& s) { return locked(s, [](Scene& scene) { return scene.size(); }); });
  c.def(
      "bodies",
      [](HeldScene& s) {
        std::vector<Id> ids;
        for (const BodyId id : locked(s, [](Scene& scene) { return scene.bodies(); })) ids.push_back(from_id(id));
        return ids;
      },
      "All ids, in order.");
  c.def(
      "name",
      [](HeldScene& s, const Id& id) { return locked(s, [&](Scene& scene) { return std::string(scene.name(to_id(id))); }); },
      py::arg("id"), "A body's name; empty if `id` names none.");
  c.def(
      "pose",
      [](HeldScene& s, const Id& id) {
        const Pose pose = locked(s, [&](Scene& scene) { return scene.pose(to_id(id)); });
        const py::object eye = py::module_::import("numpy").attr("eye")(4);
        return matrices(PoseRows(eye, QuaternionOrder::None, false), [&](std::size_t) { return pose; });
      },
      py::arg("id"), "A body's pose in the world, (4, 4); NaN if `id` names none.");
  const auto other_or = [](const ScenePointer& s, const ScenePointer& other) -> HeldScene& { return other ? *other : *s; };
  c.def(
      "overlapping",
      [=](const ScenePointer& s, const ScenePointer& other) {
        return listed(locked(*s, other_or(s, other), [](Scene& scene, Scene& o) { return scene.overlapping(o); }));
      },
      py::arg("other") = nullptr,
      "The pairs that are not proved to be disjoint: ids of A (n, 2), ids of B, and records of answers.");
  c.def(
      "within",
      [=](const ScenePointer& s, const Real& number, const ScenePointer& other) {
        const double threshold = to_double(number, "threshold");
        return listed(locked(*s, other_or(s, other), [=](Scene& scene, Scene& o) { return scene.within(o, threshold); }));
      },
      py::arg("threshold"), py::arg("other") = nullptr,
      "The pairs that are not proved to be farther apart than `threshold`: ids of A, ids of B, and records.");
  c.def(
      "distances",
      [=](const ScenePointer& s, const Real& beyond, const ScenePointer& other, const Real& absolute, const Real& relative,
          const py::object& steps) {
        const Options options = to_options(absolute, relative, beyond, steps);
        return listed(locked(*s, other_or(s, other), [&](Scene& scene, Scene& o) { return scene.distances(o, options); }));
      },
      py::arg("beyond"), py::arg("other") = nullptr, py::kw_only(), py::arg("absolute") = 0.0, py::arg("relative") = 0.0,
      py::arg("steps") = py::none(),
      "The pairs that are not proved to be farther apart than `beyond`, with their distances: ids of A, ids of B, and "
      "records.");
  c.def(
      "nearest",
      [=](const ScenePointer& s, const ScenePointer& other, const Real& absolute, const Real& relative, const Real& beyond,
          const py::object& steps) -> py::tuple {
        const Options options = to_options(absolute, relative, beyond, steps);
        const NearestPair pair =
            locked(*s, other_or(s, other), [&](Scene& scene, Scene& o) { return scene.nearest(o, options); });
        std::vector<ScenePair> found;
        if (pair.a != BodyId{}) found.push_back(pair);
        return py::make_tuple(pair.lower) + listed(found);
      },
      py::arg("other") = nullptr, py::kw_only(), py::arg("absolute") = 0.0, py::arg("relative") = 0.0,
      py::arg("beyond") = std::numeric_limits<double>::infinity(), py::arg("steps") = py::none(),
      "The nearest pair: a bound than which no pair is nearer, then ids of A, ids of B and records, of one row or none.");
  c.def(
      "contacts",
      [=](const ScenePointer& s, const ScenePointer& other, const Real& margin, const Whole& most_points,
          const Real& flatness) -> py::tuple {
        const ManifoldOptions options = to_manifold_options(margin, most_points, flatness);
        const std::vector<SceneContact> found =
            locked(*s, other_or(s, other), [&](Scene& scene, Scene& o) { return scene.contacts(o, options); });
        py::list manifolds;
        for (const SceneContact& contact : found) manifolds.append(manifold_parts(contact.manifold));
        return listed(found) + py::make_tuple(manifolds);
      },
      py::arg("other") = nullptr, py::kw_only(), py::arg("margin") = 0.0, py::arg("most_points") = 4u,
      py::arg("flatness") = 0x1p-21,
      "The pairs whose signed distance is not proved to be above `margin`: ids of A, ids of B, records, and manifolds. A pair "
      "with a\n"
      "mesh is listed once for each region; of a margin below 0 once, with its depth and no points.");
  c.def("__repr__", [](HeldScene& s) {
    return "<swiftlet.Scene: " + std::to_string(locked(s, [](Scene& scene) { return scene.size(); })) + " bodies>";
  });
}

}  // namespace swiftlet::python
