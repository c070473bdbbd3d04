// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks queries of two mapped models, for valgrind's lackey: see touched. Prints where the models lie, and writes to the
// addresses it prints around each query.
#include <cstdio>
#include <cstdlib>

#include <string>
#include <vector>

#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

namespace {
volatile long begin_query, end_query;

template <class T>
void place(int level, const char* name, std::span<const T> array) {
  const auto* const begin = reinterpret_cast<const char*>(array.data());
  if (!array.empty())
    std::printf("array %016lx %016lx %d %s\n", (unsigned long)(begin), (unsigned long)(begin + array.size_bytes()), level,
                name);
}

/// Where the arrays of a model lie.
void describe(const swiftlet::Model& model) {
  for (int i = model.finest_level(); i < model.level_count(); ++i) {
    const swiftlet::Level& level = model.level(i);
    place(i, "vertices", level.view.vertices);
    place(i, "planes", level.view.planes);
    place(i, "half_edges", level.view.half_edges);
    place(i, "face_first", level.view.face_first);
    place(i, "child_vertex", level.child_vertex);
    place(i, "child_face", level.child_face);
    place(i, "parent_face", level.parent_face);
    place(i, "map", level.support_map);
  }
}
}  // namespace

int main(int argc, char** argv) {
  using namespace swiftlet;
  if (argc != 6) return std::fputs("swiftlet_touched A.swl B.swl POSES ERROR cold|warm; error in radii\n", stderr), 2;
  const double error = std::atof(argv[4]);
  const bool cold = std::string(argv[5]) == "cold";
  std::vector<Model> models;
  for (int i = 1; i <= 2; ++i) {
    Result<Model> model = map(argv[i]);
    if (!model) return std::fprintf(stderr, "%s\n", model.error().message.c_str()), 1;
    const Detail needed{error * model.value().radius() / 2};
    models.push_back(map(argv[i], needed).value());
    const std::span<const std::byte> bytes = models.back().bytes();
    const Level& finest = models.back().level(models.back().finest_level());
    describe(models.back());
    std::printf("model %016lx %016lx %zu %zu\n", (unsigned long)(bytes.data()), (unsigned long)(bytes.data() + bytes.size()),
                finest.prefix, finest.triangle_count);
  }
  std::printf("marks %016lx %016lx\n", (unsigned long)(&begin_query), (unsigned long)(&end_query));
  std::fflush(stdout);
  const Options options{.absolute = error * models[0].radius()};
  std::FILE* file = std::fopen(argv[3], "rb");
  if (!file) return std::fprintf(stderr, "cannot read %s\n", argv[3]), 1;
  int unfinished = 0;
  PairSeed seed;
  for (Pose pose; std::fread(&pose, sizeof pose, 1, file) == 1;) {
    if (cold) seed = {};
    begin_query = 1;
    const Answer answer = distance(models[0], models[1], pose, seed, options);
    end_query = 1;
    unfinished += answer.status != Status::Converged;
  }
  std::fclose(file);
  return unfinished;
}
