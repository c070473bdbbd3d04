// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Queries over many poses and pairs, and those about one answer. Rows are cut into chunks of kPosesPerChunk wherever threads
// are; within a chunk each query starts from the seed of the one before: the bits are those of batch.h.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <swiftlet/batch.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include "arguments.h"
#include "arrays.h"
#include "crew.h"
#include "failure.h"
#include "records.h"

namespace swiftlet::python {
namespace py = pybind11;
namespace {

// ---- Records ---------------------------------------------------------------------------------------------------------------

struct Field {
  const char* name;
  std::string format;
  std::size_t offset;
};

py::dtype dtype_of(const std::vector<Field>& fields, std::size_t size) {
  py::list names, formats, offsets;
  for (const Field& f : fields) names.append(f.name), formats.append(f.format), offsets.append(f.offset);
  return {names, formats, offsets, py::ssize_t(size)};
}

template <class T>
std::size_t offset(const T& record, const void* member) {
  return std::size_t(static_cast<const char*>(member) - reinterpret_cast<const char*>(&record));
}

std::vector<Field> answer_fields(std::size_t from) {
  const Answer a;
  const auto at = [&](const auto& member) { return from + offset(a, &member); };
  static_assert(sizeof(FeatureId) == 4 && sizeof(Vec3) == 24);
  return {
      {"lower", "f8", at(a.lower)},         {"upper", "f8", at(a.upper)},        {"normal", "3f8", at(a.normal)},
      {"point_a", "3f8", at(a.point_a)},    {"point_b", "3f8", at(a.point_b)},   {"status", "u1", at(a.status)},
      {"verdict", "u1", at(a.verdict)},     {"is_signed", "?", at(a.is_signed)}, {"levels_visited", "u1", at(a.levels_visited)},
      {"level_a", "i2", at(a.level_a)},     {"level_b", "i2", at(a.level_b)},    {"feature_a", "u4", at(a.feature_a)},
      {"feature_b", "u4", at(a.feature_b)}, {"steps", "u4", at(a.steps)},        {"plane_tests", "u4", at(a.plane_tests)},
      {"radius_a", "f8", at(a.radius_a)},   {"radius_b", "f8", at(a.radius_b)}};
}

py::dtype contact_dtype() {
  const MeshContact c;
  const auto at = [&](const auto& member) { return offset(c, &member); };
  return dtype_of({{"lower", "f8", at(c.lower)},
                   {"upper", "f8", at(c.upper)},
                   {"normal", "3f8", at(c.normal)},
                   {"point_a", "3f8", at(c.point_a)},
                   {"point_b", "3f8", at(c.point_b)},
                   {"verdict", "u1", at(c.verdict)},
                   {"feature_a", "u4", at(c.feature_a)},
                   {"feature_b", "u4", at(c.feature_b)},
                   {"triangle_a", "u4", at(c.triangle_a)},
                   {"triangle_b", "u4", at(c.triangle_b)},
                   {"box_min", "3f8", at(c.box_min)},
                   {"box_max", "3f8", at(c.box_max)}},
                  sizeof c);
}

py::dtype point_dtype() {
  const ManifoldPoint p;
  const auto at = [&](const auto& member) { return offset(p, &member); };
  return dtype_of({{"point_a", "3f8", at(p.point_a)},
                   {"point_b", "3f8", at(p.point_b)},
                   {"separation", "f8", at(p.separation)},
                   {"feature_a", "u4", at(p.feature_a)},
                   {"feature_b", "u4", at(p.feature_b)}},
                  sizeof p);
}

py::dtype level_record_dtype() {
  const LevelRecord r;
  const auto at = [&](const auto& member) { return offset(r, &member); };
  return dtype_of({{"level_a", "i4", at(r.level_a)},
                   {"level_b", "i4", at(r.level_b)},
                   {"lower", "f8", at(r.lower)},
                   {"upper", "f8", at(r.upper)},
                   {"steps", "u4", at(r.steps)},
                   {"plane_tests", "u4", at(r.plane_tests)},
                   {"doubt", "u1", at(r.doubt)}},
                  sizeof r);
}

template <class T>
T* memory_of(const py::array& records) {
  return static_cast<T*>(const_cast<void*>(records.data()));
}

/// A copy of records that are Python's own, zeroed where the library writes nothing.
template <class T>
py::array copied(const py::dtype& dtype, std::span<const T> records) {
  py::array result(dtype, std::vector<py::ssize_t>{py::ssize_t(records.size())});
  if (!records.empty()) std::memcpy(memory_of<void>(result), static_cast<const void*>(records.data()), records.size_bytes());
  return result;
}

/// So many, whose number is an argument.
template <class T>
std::vector<T> allocated(const Whole& count, const char* name) {
  const std::int64_t whole = to_whole(count, name, 0, std::numeric_limits<std::int64_t>::max());
  try {
    return std::vector<T>(std::size_t(whole));
  } catch (const std::length_error&) {
  } catch (const std::bad_alloc&) {
  }
  PyErr_SetString(PyExc_MemoryError, (std::string(name) + ": no memory for " + std::to_string(whole)).c_str());
  throw py::error_already_set();
}

// ---- Seeds -----------------------------------------------------------------------------------------------------------------

/// One for each row: of convex bodies the pair's, of meshes the whole.
struct Seeds {
  std::vector<MeshSeed> seeds;
  std::atomic<bool> in_use = false;
};

/// While it lives no other call may take the seeds.
class Taken {
 public:
  explicit Taken(Seeds* seeds) : seeds_(seeds) {
    if (seeds_ && seeds_->in_use.exchange(true))
      throw std::runtime_error("seeds: another call is using them; give each its own");
  }
  ~Taken() {
    if (seeds_) seeds_->in_use = false;
  }
  Taken(const Taken&) = delete;
  Taken& operator=(const Taken&) = delete;

 private:
  Seeds* seeds_;
};

void define_seeds(py::module_& module) {
  py::class_<Seeds, std::shared_ptr<Seeds>> c(module, "Seeds",
                                              R"(Warm starts, one for each row of a batch: ``Seeds(n)`` are cold.

A query starts from its row's seed and leaves there what the next query of the same pair starts from: keep one for each pair from
time step to time step. A seed changes the work, never the truth; any bits are legal. One call at a time may use them.)");
  c.def(py::init([](const Whole& count) {
          auto s = std::make_shared<Seeds>();
          s->seeds = allocated<MeshSeed>(count, "count");
          return s;
        }),
        py::arg("count"));
  c.def("__len__", [](const Seeds& s) { return s.seeds.size(); });
  c.def(
      "reset",
      [](Seeds& s) {
        const Taken taken(&s);
        std::fill(s.seeds.begin(), s.seeds.end(), MeshSeed{});
      },
      "Makes all of them cold.");
  c.def(
      "set_pair",
      [](Seeds& s, const Whole& at, py::buffer bits) {
        const auto row = std::size_t(to_whole(at, "row", 0, std::numeric_limits<std::int64_t>::max()));
        const Taken taken(&s);
        const py::buffer_info info = bits.request();
        const std::span<const std::byte> bytes = to_bytes(info);
        if (row >= s.seeds.size() || bytes.size() != sizeof(PairSeed))
          throw py::value_error("expected a row below " + std::to_string(s.seeds.size()) + " and " +
                                std::to_string(sizeof(PairSeed)) + " bytes");
        std::memcpy(static_cast<void*>(&s.seeds[row].pair), bytes.data(), sizeof(PairSeed));
      },
      py::arg("row"), py::arg("bits"), "Sets the seed of a row for convex bodies from the bytes of a C++ ``PairSeed``.");
  c.def("__reduce__", [](const Seeds& s) {
    const py::bytes bytes(reinterpret_cast<const char*>(s.seeds.data()), s.seeds.size() * sizeof(MeshSeed));
    return made_again("Seeds", "_from_bytes", py::make_tuple(bytes));
  });
  c.def_static("_from_bytes", [](const std::string& bytes) {
    if (bytes.size() % sizeof(MeshSeed)) throw py::value_error("not the bytes of seeds");
    auto s = std::make_shared<Seeds>();
    s->seeds.resize(bytes.size() / sizeof(MeshSeed));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(s->seeds.data()), bytes.data(), bytes.size());
    return s;
  });
  c.def("__repr__", [](const Seeds& s) { return "<swiftlet.Seeds: " + std::to_string(s.seeds.size()) + ">"; });
}

// ---- Batches ---------------------------------------------------------------------------------------------------------------

/// Bodies of one side, and which of them each row is about.
struct Side {
  std::vector<OwnedBody> bodies;
  bool is_indexed = false;          ///< else all rows are about bodies[0]
  std::vector<std::uint32_t> rows;  ///< of those that are
  const OwnedBody& at(std::size_t row) const { return bodies[is_indexed ? rows[row] : 0]; }
};

Side to_side(py::handle bodies, py::handle index, const std::string& name) {
  Side side;
  const std::string index_name = "index_" + name;
  if (index.is_none()) {
    side.bodies.push_back(to_body(bodies, name.c_str()));
    return side;
  }
  if (!py::isinstance<py::sequence>(bodies))
    throw py::type_error(name + ": with " + index_name + " expected a sequence of bodies, got " + what_came(bodies));
  for (const py::handle body : py::reinterpret_borrow<py::sequence>(bodies)) side.bodies.push_back(to_body(body, name.c_str()));
  side.is_indexed = true;
  side.rows = to_indices(index, index_name.c_str());
  for (std::size_t i = 0; i < side.rows.size(); ++i)
    if (side.rows[i] >= side.bodies.size())
      throw py::index_error(index_name + ": entry " + std::to_string(i) + " is " + std::to_string(side.rows[i]) + ", of " +
                            std::to_string(side.bodies.size()) + " bodies");
  return side;
}

struct Batch {
  Side a, b;
  PoseRows poses;
  std::size_t count;
  std::vector<MeshSeed>* seeds;
  Pose pose(std::size_t row) const { return poses[poses.is_single() ? 0 : row]; }
  bool is_single() const { return poses.is_single() && !a.is_indexed && !b.is_indexed; }
  bool has_meshes() const {
    const auto any = [](const Side& side) {
      return std::any_of(side.bodies.begin(), side.bodies.end(), [](const OwnedBody& body) { return body.is_mesh(); });
    };
    return any(a) || any(b);
  }
};

std::size_t row_count(const Side& a, const Side& b, const PoseRows& poses) {
  std::size_t count = poses.size();
  bool is_known = !poses.is_single();
  const auto agree = [&](std::size_t rows, const char* name) {
    if (is_known && rows != count)
      throw py::value_error(std::string(name) + ": " + std::to_string(rows) + " rows, but there are " + std::to_string(count) +
                            " elsewhere");
    count = rows, is_known = true;
  };
  if (a.is_indexed) agree(a.rows.size(), "index_a");
  if (b.is_indexed) agree(b.rows.size(), "index_b");
  return count;
}

/// How the two kinds of queries see a body and a seed.
struct OfConvex {
  using Seed = PairSeed;
  using Pair = PairQuery;
  static constexpr std::size_t kBetweenLooks = 32;
  static const Body& body(const OwnedBody& b) { return b.convex(); }
  static PairSeed& seed(MeshSeed& s) { return s.pair; }
};
struct OfMeshes {
  using Seed = MeshSeed;
  using Pair = MeshPairQuery;
  static constexpr std::size_t kBetweenLooks = 1;
  static const MeshBody& body(const OwnedBody& b) { return b.body(); }
  static MeshSeed& seed(MeshSeed& s) { return s; }
};

/// One pair in each pose: see batch.h.
template <class Of, class Record>
void over_poses(const Asked& asked, const Batch& batch, Record* into, Unlocked& crew) {
  const auto &a = Of::body(batch.a.at(0)), &b = Of::body(batch.b.at(0));
  crew.run((batch.count + kPosesPerChunk - 1) / kPosesPerChunk, [&](std::size_t chunk) {
    typename Of::Seed seed;
    const std::size_t end = std::min(batch.count, (chunk + 1) * kPosesPerChunk);
    std::array<Pose, Of::kBetweenLooks> poses;  // some at a time: a pose just written is slow to load by wider registers
    for (std::size_t first = chunk * kPosesPerChunk; first < end; first += poses.size()) {
      if (crew.stopped()) return;
      const std::size_t count = std::min(poses.size(), end - first);
      batch.poses.copy(first, std::span(poses).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        batch.poses.prefetch(first + poses.size() + i);
        ask(asked, a, b, poses[i], seed, into[first + i]);
      }
    }
  });
}

template <class Pairs>
void ask_pairs(const Asked& q, const Pairs& pairs, std::span<Answer> into) {
  switch (q.query) {
    case Query::Distance: return distance(pairs, into, q.options);
    case Query::SignedDistance: return signed_distance(pairs, into, q.options);
    default: return intersects(pairs, into, q.effort());
  }
}
template <class Pairs>
void ask_pairs(const Asked& q, const Pairs& pairs, std::span<Within> into) {
  if (q.query == Query::Within) return within(pairs, q.threshold, into, q.effort());
  signed_within(pairs, q.threshold, into, q.effort());
}
template <class Pairs>
void ask_pairs(const Asked& q, const Pairs& pairs, std::span<ClosestFeatures> into) {
  closest_features(pairs, into, q.closest());
}

/// Rows of any bodies, each from a seed of its own or cold.
template <class Of, class Record>
void over_rows(const Asked& asked, const Batch& batch, Record* into, Unlocked& crew) {
  constexpr std::size_t kRows = 256, kSlice = Of::kBetweenLooks;
  crew.run((batch.count + kRows - 1) / kRows, [&](std::size_t task) {
    std::vector<typename Of::Pair> pairs;
    pairs.reserve(kSlice);
    const std::size_t end = std::min(batch.count, (task + 1) * kRows);
    for (std::size_t first = task * kRows; first < end; first += kSlice) {
      if (crew.stopped()) return;
      pairs.clear();
      for (std::size_t i = first; i < std::min(end, first + kSlice); ++i)
        pairs.push_back({Of::body(batch.a.at(i)), Of::body(batch.b.at(i)), batch.pose(i),
                         batch.seeds ? &Of::seed((*batch.seeds)[i]) : nullptr});
      ask_pairs(asked, std::span<const typename Of::Pair>(pairs), std::span(into + first, pairs.size()));
    }
  });
}

template <class Record>
void ask_all(const Asked& asked, const Batch& batch, Record* into, unsigned threads) {
  if (batch.count == 0) return;
  Unlocked crew(threads);
  const bool is_one_pair = !batch.a.is_indexed && !batch.b.is_indexed && !batch.seeds;
  if (batch.has_meshes()) {
    is_one_pair ? over_poses<OfMeshes>(asked, batch, into, crew) : over_rows<OfMeshes>(asked, batch, into, crew);
  } else {
    is_one_pair ? over_poses<OfConvex>(asked, batch, into, crew) : over_rows<OfConvex>(asked, batch, into, crew);
  }
  crew.finish();
}

/// Per row the kind, the vertices, and the triangles as lists behind each other.
py::tuple sources(std::span<const ClosestFeatures> found, SourceFeature ClosestFeatures::*which) {
  const auto count = py::ssize_t(found.size());
  py::array_t<std::uint8_t> kinds(count);
  py::array_t<std::uint32_t> vertices({count, py::ssize_t(2)});
  py::array_t<std::int64_t> begins(count + 1);
  std::vector<std::uint32_t> triangles;
  begins.mutable_at(0) = 0;
  for (py::ssize_t i = 0; i < count; ++i) {
    const SourceFeature& s = found[std::size_t(i)].*which;
    kinds.mutable_at(i) = std::uint8_t(s.kind);
    vertices.mutable_at(i, 0) = s.vertices[0], vertices.mutable_at(i, 1) = s.vertices[1];
    triangles.insert(triangles.end(), s.triangles.begin(), s.triangles.end());
    begins.mutable_at(i + 1) = std::int64_t(triangles.size());
  }
  return py::make_tuple(kinds, vertices, begins, to_array(std::span<const std::uint32_t>(triangles)));
}

Query query_of(py::handle query) {
  if (!py::isinstance<py::str>(query)) throw py::type_error("query: expected the name of a query, got " + what_came(query));
  const auto name = query.cast<std::string>();
  constexpr const char* kNames[] = {"distance", "signed_distance", "intersects", "within", "signed_within", "closest_features"};
  for (int k = 0; k < 6; ++k)
    if (name == kNames[k]) return Query(k);
  throw py::value_error("query: expected the name of a query, got '" + name + "'");
}

Asked to_asked(Query query, const Real& threshold, const Real& absolute, const Real& relative, const Real& beyond,
               const py::object& steps, const Whole& finest_level, const py::object& tuning) {
  Asked asked;
  asked.query = query;
  asked.threshold = to_double(threshold, "threshold");
  asked.options.absolute = to_double(absolute, "absolute"), asked.options.relative = to_double(relative, "relative");
  asked.options.beyond = to_double(beyond, "beyond");
  if (!steps.is_none()) asked.options.budget.steps = to_steps(steps);
  asked.options.budget.finest_level = to_int(finest_level, "finest_level");
  asked.options.tuning = to_tuning(tuning);
  return asked;
}

/// Those of `out` to write again, or new ones.
py::array records_for(py::handle out, const py::dtype& dtype, std::size_t count, bool is_single) {
  if (out.is_none()) return new_records(dtype, count, is_single);
  if (!py::isinstance<py::array>(out) || !py::reinterpret_borrow<py::array>(out).dtype().equal(dtype))
    throw py::type_error("out: expected answers of the same query, got " + what_came(out));
  const auto records = py::reinterpret_borrow<py::array>(out);
  if (records.ndim() != (is_single ? 0 : 1) || records.size() != py::ssize_t(is_single ? 1 : count))
    throw py::value_error("out: expected " + (is_single ? "one answer" : std::to_string(count) + " rows") + ", got " +
                          what_came(out));
  if (!records.writeable() || !(records.flags() & py::array::c_style))
    throw py::value_error("out: expected rows that are writeable and next to each other");
  return records;
}

std::shared_ptr<Seeds> to_seeds(py::handle seeds) {
  if (seeds.is_none()) return nullptr;
  if (!py::isinstance<Seeds>(seeds)) throw py::type_error("seeds: expected Seeds, got " + what_came(seeds));
  return seeds.cast<std::shared_ptr<Seeds>>();
}

py::object run_query(py::handle name, py::handle a, py::handle b, py::handle poses, const Real& threshold, const Real& absolute,
                     const Real& relative, const Real& beyond, const py::object& steps, const Whole& finest_level,
                     const py::object& tuning, py::handle index_a, py::handle index_b, py::handle given_seeds,
                     const Whole& threads, py::handle quaternion, Flag copy, py::handle out) {
  const Asked asked = to_asked(query_of(name), threshold, absolute, relative, beyond, steps, finest_level, tuning);
  const unsigned count = to_threads(threads);
  const std::shared_ptr<Seeds> seeds = to_seeds(given_seeds);
  Batch batch{to_side(a, index_a, "a"), to_side(b, index_b, "b"), PoseRows(poses, quaternion_order(quaternion), copy), 0,
              seeds ? &seeds->seeds : nullptr};
  batch.count = row_count(batch.a, batch.b, batch.poses);
  if (seeds && seeds->seeds.size() != batch.count)
    throw py::value_error("seeds: " + std::to_string(seeds->seeds.size()) + " seeds for " + std::to_string(batch.count) +
                          " rows");
  const Taken taken(seeds.get());
  const bool is_single = batch.is_single();
  if (asked.query == Query::Within || asked.query == Query::SignedWithin) {
    const py::array records = records_for(out, within_dtype(), batch.count, is_single);
    ask_all(asked, batch, memory_of<Within>(records), count);
    return records;
  }
  const py::array records = records_for(out, answer_dtype(), batch.count, is_single);
  if (asked.query != Query::ClosestFeatures) {
    ask_all(asked, batch, memory_of<Answer>(records), count);
    return records;
  }
  std::vector<ClosestFeatures> found(batch.count);
  ask_all(asked, batch, found.data(), count);
  for (std::size_t i = 0; i < found.size(); ++i) memory_of<Answer>(records)[i] = found[i].answer;
  return py::make_tuple(records, sources(found, &ClosestFeatures::source_a), sources(found, &ClosestFeatures::source_b));
}

// ---- About answers ---------------------------------------------------------------------------------------------------------

/// Bodies, one pose and their kind.
struct One {
  OwnedBody a, b;
  PoseRows poses;
  One(py::handle a_, py::handle b_, py::handle poses_, py::handle quaternion, bool copy)
      : a(to_body(a_, "a")), b(to_body(b_, "b")), poses(poses_, quaternion_order(quaternion), copy) {}
  bool has_mesh() const { return a.is_mesh() || b.is_mesh(); }
  const One& single(const char* what) const {
    if (!poses.is_single())
      throw py::value_error(std::string("pose: ") + what + " takes one, got " + std::to_string(poses.size()));
    return *this;
  }
  const One& convex(const char* what) const {
    if (has_mesh()) throw py::type_error(std::string(what) + " is about convex bodies, got a mesh");
    return *this;
  }
};

std::vector<Answer> to_answers(py::handle records, std::size_t count, const char* name) {
  if (!py::isinstance<py::array>(records) || !py::reinterpret_borrow<py::array>(records).dtype().equal(answer_dtype()))
    throw py::type_error(std::string(name) + ": expected answers, got " + what_came(records));
  const py::array array = py::module_::import("numpy").attr("ascontiguousarray")(records);
  if (array.size() != py::ssize_t(count))
    throw py::value_error(std::string(name) + ": " + std::to_string(array.size()) + " answers for " + std::to_string(count) +
                          " poses");
  std::vector<Answer> answers(count);
  for (std::size_t i = 0; i < count; ++i) {
    unsigned char raw[sizeof(Answer)];
    std::memcpy(raw, static_cast<const char*>(array.data()) + i * sizeof(Answer), sizeof raw);
    static const std::size_t kFlag = [] {
      const Answer a;
      return offset(a, &a.is_signed);
    }();
    raw[kFlag] = raw[kFlag] != 0;
    std::memcpy(static_cast<void*>(&answers[i]), raw, sizeof raw);
  }
  return answers;
}

py::array run_refine(py::handle a, py::handle b, py::handle poses, py::handle so_far, const Real& absolute,
                     const Real& relative, const Real& beyond, const py::object& steps, const Whole& finest_level,
                     const py::object& tuning, const Whole& threads, py::handle quaternion, Flag copy) {
  const One one(a, b, poses, quaternion, copy);
  one.convex("refine");
  const Asked asked = to_asked(Query::Distance, py::float_(0.0), absolute, relative, beyond, steps, finest_level, tuning);
  const std::vector<Answer> before = to_answers(so_far, one.poses.size(), "so_far");
  const py::array records = new_records(answer_dtype(), before.size(), one.poses.is_single());
  Answer* into = memory_of<Answer>(records);
  Unlocked crew(to_threads(threads));
  crew.run((before.size() + kPosesPerChunk - 1) / kPosesPerChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(before.size(), (chunk + 1) * kPosesPerChunk);
    for (std::size_t i = chunk * kPosesPerChunk; i < end && (i % 32 || !crew.stopped()); ++i)
      into[i] = refine(one.a.convex(), one.b.convex(), one.poses[i], before[i], asked.options);
  });
  crew.finish();
  return records;
}

py::array run_tolerance(py::handle a, py::handle b, py::handle poses, py::handle quaternion, Flag copy) {
  const One one(a, b, poses, quaternion, copy);
  std::vector<py::ssize_t> shape;
  if (!one.poses.is_single()) shape.push_back(py::ssize_t(one.poses.size()));
  py::array_t<double> result(shape);
  double* out = result.mutable_data();
  for (std::size_t i = 0; i < one.poses.size(); ++i)
    out[i] = one.has_mesh() ? tolerance(one.a.body(), one.b.body(), one.poses[i])
                            : tolerance(one.a.convex(), one.b.convex(), one.poses[i]);
  return result;
}

std::string run_check(py::handle a, py::handle b, py::handle pose, py::handle answer, Flag exact, py::handle quaternion,
                      Flag copy) {
  const One one(a, b, pose, quaternion, copy);
  one.single("check");
  const std::vector<Answer> answers = to_answers(answer, 1, "answer");
  Unlocked crew;
  std::optional<Check> result;
  result = one.has_mesh()
               ? check(one.a.body(), one.b.body(), one.poses[0], answers[0])
               : check(one.a.convex(), one.b.convex(), one.poses[0], answers[0], exact ? Question::Exact : Question::Any);
  crew.finish();
  return result->ok ? std::string() : result->message;
}

py::tuple run_trace(py::handle name, py::handle a, py::handle b, py::handle pose, const Real& threshold, const Real& absolute,
                    const Real& relative, const Real& beyond, const py::object& steps, const Whole& finest_level,
                    const py::object& tuning, py::handle quaternion, Flag copy) {
  const One one(a, b, pose, quaternion, copy);
  one.single("trace").convex("trace");
  Asked asked = to_asked(query_of(name), threshold, absolute, relative, beyond, steps, finest_level, tuning);
  std::vector<LevelRecord> trace(256);
  OverlapProof proof;
  asked.options.tuning.trace = trace;
  asked.options.tuning.proof = &proof;
  PairSeed cold;
  Within answer;
  if (asked.query == Query::Within || asked.query == Query::SignedWithin) {
    ask(asked, one.a.convex(), one.b.convex(), one.poses[0], cold, answer);
  } else if (asked.query == Query::ClosestFeatures) {
    answer.answer = closest_features(one.a.convex(), one.b.convex(), one.poses[0], cold, asked.closest()).answer;
  } else {
    ask(asked, one.a.convex(), one.b.convex(), one.poses[0], cold, answer.answer);
  }
  const bool has_decision = asked.query == Query::Within || asked.query == Query::SignedWithin;
  const py::array record = new_records(has_decision ? within_dtype() : answer_dtype(), 1, true);
  if (has_decision)
    *memory_of<Within>(record) = answer;
  else
    *memory_of<Answer>(record) = answer.answer;
  py::array_t<std::uint32_t> pairs({py::ssize_t(proof.count), py::ssize_t(2)});
  for (std::uint32_t k = 0; k < proof.count; ++k)
    pairs.mutable_at(k, 0) = proof.vertex_a[k], pairs.mutable_at(k, 1) = proof.vertex_b[k];
  return py::make_tuple(record,
                        copied(level_record_dtype(), std::span<const LevelRecord>(trace).first(
                                                         std::min<std::size_t>(256, answer.answer.levels_visited))),
                        pairs);
}

py::tuple run_contacts(py::handle a, py::handle b, py::handle pose, const Real& reach, const Whole& most,
                       const py::object& steps, py::handle quaternion, Flag copy) {
  const double within = to_double(reach, "reach");
  const One one(a, b, pose, quaternion, copy);
  one.single("contacts");
  Budget budget;
  if (!steps.is_none()) budget.steps = to_steps(steps);
  std::vector<MeshContact> into = allocated<MeshContact>(most, "most");
  Unlocked crew;
  const MeshContacts found = contacts(one.a.body(), one.b.body(), one.poses[0], within, into, budget);
  crew.finish();
  return py::make_tuple(int(found.status), found.is_counted, found.count, found.steps, found.plane_tests,
                        copied(contact_dtype(), std::span<const MeshContact>(into).first(found.stored)));
}

FeatureId feature(std::uint32_t bits) { return {FeatureKind(bits >> 30), bits & 0x3fffffffu}; }

Manifold manifold_of(py::handle parts) {
  Manifold m;
  if (parts.is_none()) return m;
  const auto tuple = parts.cast<py::tuple>();
  m.normal = to_vec3(tuple[0], "previous");
  m.face_a = feature(tuple[1].cast<std::uint32_t>()), m.face_b = feature(tuple[2].cast<std::uint32_t>());
  const py::array points = py::module_::import("numpy").attr("ascontiguousarray")(tuple[3], point_dtype());
  m.count = std::uint32_t(std::min<py::ssize_t>(points.size(), kMostManifoldPoints));
  if (m.count) std::memcpy(static_cast<void*>(m.points.data()), points.data(), m.count * sizeof(ManifoldPoint));
  return m;
}

py::tuple run_manifold(py::handle a, py::handle b, py::handle pose, py::handle answer, const Real& margin,
                       const Whole& most_points, const Real& flatness, py::handle previous, py::handle quaternion, Flag copy) {
  const One one(a, b, pose, quaternion, copy);
  one.single("manifold");
  const ManifoldOptions options = to_manifold_options(margin, most_points, flatness);
  const Manifold before = manifold_of(previous);
  if (!one.has_mesh() && py::isinstance<py::array>(answer) &&
      py::reinterpret_borrow<py::array>(answer).dtype().equal(answer_dtype()))
    return manifold_parts(
        manifold(one.a.convex(), one.b.convex(), one.poses[0], to_answers(answer, 1, "answer")[0], options, before));
  const py::dtype contact = contact_dtype();
  if (!py::isinstance<py::array>(answer) || !py::reinterpret_borrow<py::array>(answer).dtype().equal(contact))
    throw py::type_error("answer: expected " + std::string(one.has_mesh() ? "a contact of `contacts`" : "an answer") +
                         ", got " + what_came(answer));
  const py::array record = py::module_::import("numpy").attr("ascontiguousarray")(answer);
  if (record.size() != 1) throw py::value_error("answer: expected one contact, got " + std::to_string(record.size()));
  MeshContact c;
  std::memcpy(static_cast<void*>(&c), record.data(), sizeof c);
  return manifold_parts(manifold(one.a.body(), one.b.body(), one.poses[0], c, options, before));
}

}  // namespace

Tuning to_tuning(py::handle tuning) {
  Tuning t;
  if (tuning.is_none()) return t;
  const auto member = [&](const char* name) -> py::object {
    if (!py::hasattr(tuning, name)) throw py::type_error("tuning: expected a Tuning, got " + what_came(tuning));
    return tuning.attr(name);
  };
  const auto number = [&](const char* name, int count) {
    return to_whole(member(name), (std::string("tuning.") + name).c_str(), 0, count - 1);
  };
  t.start = StartPolicy(number("start", 5));
  t.refinement = Refinement(number("refinement", 3));
  t.plane_rule = PlaneRule(number("plane_rule", 2));
  t.careful = is_true(member("careful"));
  return t;
}

ManifoldOptions to_manifold_options(const Real& margin, const Whole& most_points, const Real& flatness) {
  return {to_double(margin, "margin"), std::uint32_t(to_whole(most_points, "most_points", 1, kMostManifoldPoints)),
          to_double(flatness, "flatness")};
}

// Made once and never freed: the interpreter may be gone before what is static here.
py::dtype answer_dtype() {
  static const auto* made = new py::dtype(dtype_of(answer_fields(0), sizeof(Answer)));
  return *made;
}

py::dtype within_dtype() {
  static const auto* made = [] {
    const Within w;
    std::vector<Field> fields = answer_fields(offset(w, &w.answer));
    fields.insert(fields.begin(), {"decision", "u1", offset(w, &w.decision)});
    return new py::dtype(dtype_of(fields, sizeof w));
  }();
  return *made;
}

py::array new_records(const py::dtype& dtype, std::size_t count, bool is_single) {
  std::vector<py::ssize_t> shape;
  if (!is_single) shape.push_back(py::ssize_t(count));
  return {dtype, shape};
}

py::tuple manifold_parts(const Manifold& m) {
  return py::make_tuple(to_array(m.normal), std::uint32_t(m.face_a.kind()) << 30 | m.face_a.index(),
                        std::uint32_t(m.face_b.kind()) << 30 | m.face_b.index(),
                        copied(point_dtype(), std::span<const ManifoldPoint>(m.points).first(m.count)));
}

void define_queries(py::module_& module) {
  define_seeds(module);
  const auto none = py::none();
  module.def("run_query", &run_query, py::arg("query"), py::arg("a"), py::arg("b"), py::arg("poses"), py::arg("threshold"),
             py::arg("absolute"), py::arg("relative"), py::arg("beyond"), py::arg("steps"), py::arg("finest_level"),
             py::arg("tuning"), py::arg("index_a"), py::arg("index_b"), py::arg("seeds"), py::arg("threads"),
             py::arg("quaternion"), py::arg("copy"), py::arg("out"),
             "Asks a query in each pose; its records, or with closest_features also both sides' sources.");
  module.def("run_refine", &run_refine, py::arg("a"), py::arg("b"), py::arg("poses"), py::arg("so_far"), py::arg("absolute"),
             py::arg("relative"), py::arg("beyond"), py::arg("steps"), py::arg("finest_level"), py::arg("tuning"),
             py::arg("threads"), py::arg("quaternion"), py::arg("copy"), "Continues distances from their records.");
  module.def("run_tolerance", &run_tolerance, py::arg("a"), py::arg("b"), py::arg("poses"), py::arg("quaternion"),
             py::arg("copy"), "Law 2's bound in each pose.");
  module.def("run_check", &run_check, py::arg("a"), py::arg("b"), py::arg("pose"), py::arg("answer"), py::arg("exact"),
             py::arg("quaternion"), py::arg("copy"), "What fails first of an answer; empty if all holds.");
  module.def("run_trace", &run_trace, py::arg("query"), py::arg("a"), py::arg("b"), py::arg("pose"), py::arg("threshold"),
             py::arg("absolute"), py::arg("relative"), py::arg("beyond"), py::arg("steps"), py::arg("finest_level"),
             py::arg("tuning"), py::arg("quaternion"), py::arg("copy"),
             "A record, the level pairs visited, and the proof of an overlap.");
  module.def("run_contacts", &run_contacts, py::arg("a"), py::arg("b"), py::arg("pose"), py::arg("reach"), py::arg("most"),
             py::arg("steps"), py::arg("quaternion"), py::arg("copy"),
             "Status, is_counted, count, steps, plane_tests and records of the regions.");
  module.def("run_manifold", &run_manifold, py::arg("a"), py::arg("b"), py::arg("pose"), py::arg("answer"), py::arg("margin"),
             py::arg("most_points"), py::arg("flatness"), py::arg("previous"), py::arg("quaternion"), py::arg("copy"),
             "Normal, both faces and records of the points.");
  module.def("answer_dtype", &answer_dtype, "The dtype of an answer's record.");
  module.def("within_dtype", &within_dtype, "The dtype of a record with a decision.");
  module.def(
      "run_relative",
      [](py::handle a, py::handle b, py::handle quaternion, Flag copy) {
        const QuaternionOrder order = quaternion_order(quaternion);
        const PoseRows of_a(a, order, copy, "a_in_world"), of_b(b, order, copy, "b_in_world");
        if (!of_a.is_single() && !of_b.is_single() && of_a.size() != of_b.size())
          throw py::value_error("b_in_world: " + std::to_string(of_b.size()) + " poses, but a_in_world has " +
                                std::to_string(of_a.size()));
        return matrices(of_a.is_single() ? of_b : of_a, [&](std::size_t i) {
          return relative(of_a[of_a.is_single() ? 0 : i], of_b[of_b.is_single() ? 0 : i]);
        });
      },
      py::arg("a_in_world"), py::arg("b_in_world"), py::arg("quaternion"), py::arg("copy"),
      "Poses of B in A's frame, as matrices.");
  module.def(
      "run_inverse",
      [](py::handle poses, py::handle quaternion, Flag copy) {
        const PoseRows rows(poses, quaternion_order(quaternion), copy);
        return matrices(rows, [&](std::size_t i) { return inverse(rows[i]); });
      },
      py::arg("poses"), py::arg("quaternion"), py::arg("copy"), "The poses that undo these, as matrices.");
  module.def(
      "run_matrix",
      [](py::handle poses, py::handle quaternion, Flag copy) {
        const PoseRows rows(poses, quaternion_order(quaternion), copy);
        return matrices(rows, [&](std::size_t i) { return rows[i]; });
      },
      py::arg("poses"), py::arg("quaternion"), py::arg("copy"), "Poses of any form as matrices.");
}

}  // namespace swiftlet::python
