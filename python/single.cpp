// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One pair asked pose by pose, in a planner's inner loop: arguments are read by hand, and an Answer is one block of memory.
#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <string>

#include <swiftlet/depth.h>
#include <swiftlet/mesh_query.h>

#include "arguments.h"
#include "arrays.h"
#include "failure.h"
#include "records.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

// ---- Answer ----------------------------------------------------------------------------------------------------------------

struct AnswerObject {
  PyObject_HEAD Answer answer;
  int decision;  ///< below 0: none was asked for
};

PyTypeObject* answer_type = nullptr;

PyObject* new_answer(const Answer& answer, int decision) {
  auto* self = reinterpret_cast<AnswerObject*>(answer_type->tp_alloc(answer_type, 0));
  if (!self) return nullptr;
  new (&self->answer) Answer(answer);
  self->decision = decision;
  return reinterpret_cast<PyObject*>(self);
}

const AnswerObject& object_of(PyObject* self) { return *reinterpret_cast<AnswerObject*>(self); }

/// A member of an enumeration; those are made once.
PyObject* member(const char* enumeration, int value) {
  return py::module_::import("swiftlet._errors").attr(enumeration)(value).release().ptr();
}

/// Calls `get`; exceptions become Python's.
template <auto kGet>
PyObject* getter(PyObject* self, void*) {
  try {
    return kGet(object_of(self));
  } catch (py::error_already_set& raised) {
    raised.restore();
    return nullptr;
  }
}

template <auto kMember>
PyObject* get_number(PyObject* self, void*) {
  const auto value = object_of(self).answer.*kMember;
  if constexpr (std::is_same_v<decltype(value), const double>)
    return PyFloat_FromDouble(value);
  else if constexpr (std::is_same_v<decltype(value), const bool>)
    return PyBool_FromLong(value);
  else if constexpr (std::is_same_v<decltype(value), const FeatureId>)
    return PyLong_FromUnsignedLong(std::uint32_t(value.kind()) << 30 | value.index());
  else
    return PyLong_FromLongLong(value);
}
template <auto kMember>
PyObject* get_vector(const AnswerObject& a) {
  return to_array(a.answer.*kMember).release().ptr();
}
PyObject* get_status(const AnswerObject& a) { return member("Status", int(a.answer.status)); }
PyObject* get_verdict(const AnswerObject& a) { return member("Verdict", int(a.answer.verdict)); }
PyObject* get_decision(const AnswerObject& a) {
  return a.decision < 0 ? py::none().release().ptr() : member("Decision", a.decision);
}
PyObject* get_value(const AnswerObject& a) { return PyFloat_FromDouble(a.answer.value()); }
PyObject* get_record(const AnswerObject& a) {
  const py::array record = new_records(answer_dtype(), 1, true);
  std::memcpy(const_cast<void*>(record.data()), static_cast<const void*>(&a.answer), sizeof(Answer));
  return py::object(record).release().ptr();
}

PyGetSetDef answer_members[] = {
    {"status", getter<get_status>, nullptr, "How the query ended: a :class:`Status`.", nullptr},
    {"verdict", getter<get_verdict>, nullptr, "What is proved: a :class:`Verdict`.", nullptr},
    {"decision", getter<get_decision>, nullptr, "Of `within` and `signed_within` a :class:`Decision`, else None.", nullptr},
    {"lower", get_number<&Answer::lower>, nullptr, "Proved lower bound on the distance, in the bodies' unit.", nullptr},
    {"upper", get_number<&Answer::upper>, nullptr, "Proved upper bound.", nullptr},
    {"value", getter<get_value>, nullptr, "Middle of the interval; NaN if a bound is infinite.", nullptr},
    {"normal", getter<get_vector<&Answer::normal>>, nullptr, "Unit, from A to B, in A's frame, (3,); NaN where none is known.",
     nullptr},
    {"point_a", getter<get_vector<&Answer::point_a>>, nullptr, "Witness point of A in A's frame, (3,).", nullptr},
    {"point_b", getter<get_vector<&Answer::point_b>>, nullptr, "Witness point of B in A's frame, (3,).", nullptr},
    {"is_signed", get_number<&Answer::is_signed>, nullptr, "True if the bounds are of the signed distance.", nullptr},
    {"level_a", get_number<&Answer::level_a>, nullptr, "The level of A that answered.", nullptr},
    {"level_b", get_number<&Answer::level_b>, nullptr, "The level of B that answered.", nullptr},
    {"levels_visited", get_number<&Answer::levels_visited>, nullptr, "Number of level pairs visited.", nullptr},
    {"feature_a", get_number<&Answer::feature_a>, nullptr, "Id of the feature of A that holds `point_a`.", nullptr},
    {"feature_b", get_number<&Answer::feature_b>, nullptr, "Id of the feature of B that holds `point_b`.", nullptr},
    {"steps", get_number<&Answer::steps>, nullptr, "Changes of feature; of meshes pairs of nodes opened.", nullptr},
    {"plane_tests", get_number<&Answer::plane_tests>, nullptr, "Planes and supports evaluated; of meshes pairs of triangles.",
     nullptr},
    {"radius_a", get_number<&Answer::radius_a>, nullptr, "A's radius.", nullptr},
    {"radius_b", get_number<&Answer::radius_b>, nullptr, "B's radius.", nullptr},
    {"record", getter<get_record>, nullptr, "The answer as a structured array of shape (), as :class:`Answers` holds them.",
     nullptr},
    {nullptr, nullptr, nullptr, nullptr, nullptr}};

PyObject* answer_repr(PyObject* self) {
  try {
    return py::module_::import("swiftlet._answers").attr("describe")(py::handle(self)).release().ptr();
  } catch (py::error_already_set& raised) {
    raised.restore();
    return nullptr;
  }
}

void answer_free(PyObject* self) {
  PyTypeObject* type = Py_TYPE(self);
  type->tp_free(self);
  Py_DECREF(type);
}

PyObject* make_answer_type() {
  static PyType_Slot slots[] = {
      {Py_tp_doc,
       const_cast<char*>("What a :class:`Pair` answers: a proved interval, and the points and direction that prove it.")},
      {Py_tp_getset, answer_members},
      {Py_tp_repr, reinterpret_cast<void*>(&answer_repr)},
      {Py_tp_dealloc, reinterpret_cast<void*>(&answer_free)},
      {0, nullptr}};
  static PyType_Spec spec = {"swiftlet._runtime.Answer", sizeof(AnswerObject), 0,
                             Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};
  return PyType_FromSpec(&spec);
}

// ---- Pair ------------------------------------------------------------------------------------------------------------------

struct Pair {
  OwnedBody a, b;
  QuaternionOrder order;
  Tuning tuning;
  MeshSeed seed{};
  bool has_mesh() const { return a.is_mesh() || b.is_mesh(); }
};

/// The pair of a method's self, whose type the descriptor has checked.
Pair& pair_of(PyObject* self) {
  auto* instance = reinterpret_cast<py::detail::instance*>(self);
  void* value = instance->simple_layout ? instance->simple_value_holder[0] : nullptr;
  if (!value) return py::cast<Pair&>(py::handle(self));  // of a class derived in Python, or raises
  return *static_cast<Pair*>(value);
}

void set_option(Asked& asked, const char* name, PyObject* value) {
  const std::string_view key = name;
  const bool is_distance = asked.query == Query::Distance || asked.query == Query::SignedDistance;
  if (key == "steps") {
    if (value != Py_None) asked.options.budget.steps = to_steps(value);
  } else if (key == "finest_level") {
    asked.options.budget.finest_level = to_int(value, name);
  } else if (key == "absolute" && is_distance) {
    asked.options.absolute = to_double(value, name);
  } else if (key == "relative" && is_distance) {
    asked.options.relative = to_double(value, name);
  } else if (key == "beyond" && is_distance) {
    asked.options.beyond = to_double(value, name);
  } else if (key == "threshold" && !is_distance && asked.query != Query::Intersects) {
    asked.threshold = to_double(value, name);
  } else {
    throw py::type_error("unexpected keyword argument '" + std::string(key) + "'");
  }
}

template <class Record>
void ask_pair(const Asked& asked, Pair& pair, const Pose& pose, Record& record) {
  if (!pair.has_mesh()) return ask(asked, pair.a.convex(), pair.b.convex(), pose, pair.seed.pair, record);
  MeshSeed seed = pair.seed;  // others may ask the pair meanwhile
  {
    const py::gil_scoped_release release;
    ask(asked, pair.a.body(), pair.b.body(), pose, seed, record);
  }
  pair.seed = seed;
}

template <Query kQuery>
PyObject* method(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
  constexpr bool kDecides = kQuery == Query::Within || kQuery == Query::SignedWithin;
  constexpr Py_ssize_t kPositional = kDecides ? 2 : 1;
  try {
    Pair& pair = pair_of(self);
    Asked asked;
    asked.query = kQuery;
    asked.options.tuning = pair.tuning;
    bool has_threshold = count > 1;
    if (count < 1 || count > kPositional)
      throw py::type_error("expected " + std::string(kDecides ? "a pose and a threshold" : "a pose") + ", got " +
                           std::to_string(count) + " positional arguments");
    if constexpr (kDecides)
      if (has_threshold) asked.threshold = to_double(arguments[1], "threshold");
    if (names) {
      for (Py_ssize_t k = 0; k < PyTuple_GET_SIZE(names); ++k) {
        const char* name = PyUnicode_AsUTF8(PyTuple_GET_ITEM(names, k));
        if (!name) throw py::error_already_set();
        const bool is_threshold = std::string_view(name) == "threshold";
        if (is_threshold && has_threshold) throw py::type_error("got multiple values for argument 'threshold'");
        set_option(asked, name, arguments[count + k]);
        has_threshold = has_threshold || is_threshold;
      }
    }
    if (kDecides && !has_threshold) throw py::type_error("missing argument 'threshold'");
    const PoseRows pose(arguments[0], pair.order, false, "pose");
    if (!pose.is_single())
      throw py::value_error("pose: a Pair takes one, got " + std::to_string(pose.size()) + "; ask swiftlet's functions");
    if constexpr (kDecides) {
      Within within;
      ask_pair(asked, pair, pose[0], within);
      return new_answer(within.answer, int(within.decision));
    } else {
      Answer answer;
      ask_pair(asked, pair, pose[0], answer);
      return new_answer(answer, -1);
    }
  } catch (py::error_already_set& raised) {
    raised.restore();
  } catch (const py::builtin_exception& raised) {
    raised.set_error();
  } catch (const std::exception& raised) {
    PyErr_SetString(PyExc_RuntimeError, raised.what());
  }
  return nullptr;
}

template <Query kQuery>
PyMethodDef definition(const char* name, const char* text) {
  return {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void*>(&method<kQuery>)), METH_FASTCALL | METH_KEYWORDS, text};
}

PyMethodDef pair_methods[] = {
    definition<Query::Distance>(
        "distance",
        "distance($self, pose, /, *, absolute=0.0, relative=0.0, beyond=1e999, steps=None, finest_level=0)\n--\n\n"
        "The distance in one pose: see :func:`swiftlet.distance`. Returns an :class:`Answer`."),
    definition<Query::SignedDistance>(
        "signed_distance",
        "signed_distance($self, pose, /, *, absolute=0.0, relative=0.0, beyond=1e999, steps=None, finest_level=0)\n--\n\n"
        "The signed distance in one pose: see :func:`swiftlet.signed_distance`. Returns an :class:`Answer`."),
    definition<Query::Intersects>("intersects",
                                  "intersects($self, pose, /, *, steps=None, finest_level=0)\n--\n\n"
                                  "Whether the bodies share a point: read `verdict`. Returns an :class:`Answer`."),
    definition<Query::Within>("within",
                              "within($self, pose, /, threshold, *, steps=None, finest_level=0)\n--\n\n"
                              "Whether the distance is at most `threshold`: read `decision`. Returns an :class:`Answer`."),
    definition<Query::SignedWithin>(
        "signed_within",
        "signed_within($self, pose, /, threshold, *, steps=None, finest_level=0)\n--\n\n"
        "Whether the signed distance is at most `threshold`: read `decision`. Returns an :class:`Answer`.")};

}  // namespace

void define_single(py::module_& module) {
  const auto type = py::reinterpret_steal<py::object>(make_answer_type());
  if (!type) throw py::error_already_set();
  answer_type = reinterpret_cast<PyTypeObject*>(type.ptr());
  module.attr("Answer") = type;
  refuse_pickles(type);

  py::class_<Pair> c(module, "Pair", R"(Two bodies and the warm start between them, asked one pose at a time.

For loops that know the next pose only after the last answer: less than a microsecond a call for convex bodies. Each call starts
where the last one ended. A pose is float64 of shape (4, 4), a tuple of (3, 3) and (3,), or of shape (7,), and maps B's frame into
A's. Of many poses ask :func:`swiftlet.distance` and its like.

Parameters
----------
a, b : Model, MeshModel or Body
quaternion : {None, "xyzw", "wxyz"}
    The order of the last four of seven numbers.
tuning : Tuning, optional
)");
  c.def(py::init([](py::handle a, py::handle b, py::handle quaternion, py::handle tuning) {
          return Pair{to_body(a, "a"), to_body(b, "b"), quaternion_order(quaternion), to_tuning(tuning)};
        }),
        py::arg("a"), py::arg("b"), py::kw_only(), py::arg("quaternion") = py::none(), py::arg("tuning") = py::none());
  refuse_pickles(c);
  c.def(
      "reset", [](Pair& p) { p.seed = {}; }, "Forgets the warm start.");
  c.def_property_readonly(
      "a", [](const Pair& p) { return p.a; }, "Body A.");
  c.def_property_readonly(
      "b", [](const Pair& p) { return p.b; }, "Body B.");
  c.def_property(
      "seed", [](const Pair& p) { return py::bytes(reinterpret_cast<const char*>(&p.seed.pair), sizeof(PairSeed)); },
      [](Pair& p, const std::string& bits) {
        if (bits.size() != sizeof(PairSeed))
          throw py::value_error("seed: expected " + std::to_string(sizeof(PairSeed)) + " bytes");
        std::memcpy(static_cast<void*>(&p.seed.pair), bits.data(), bits.size());
      },
      "The warm start of convex bodies, the bytes of a C++ ``PairSeed``; any are legal.");
  c.def("__repr__", [](const Pair& p) {
    return "<swiftlet.Pair: " + std::string(py::repr(py::cast(p.a))) + ", " + std::string(py::repr(py::cast(p.b))) + ">";
  });
  for (PyMethodDef& m : pair_methods) {
    const auto descriptor = py::reinterpret_steal<py::object>(PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(c.ptr()), &m));
    if (!descriptor) throw py::error_already_set();
    c.attr(m.ml_name) = descriptor;
  }
}

}  // namespace swiftlet::python
