// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks one question about every pose of a scene by registers of SSE2, for callgrind: what `ask_all` takes are the queries
// alone, from the seed that an earlier pass left. Its meshes are those of files, or made here without hulls: what makes hulls
// needs CGAL, which valgrind does not bear. See count.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "method.h"
#include "numeric/width.h"
#include "questions.h"
#include "scenes.h"

using namespace swiftlet::bench::mesh;

struct Work {
  double opened = 0, looked_at = 0, sum = 0;
};

[[gnu::noinline]] Work ask_all(Session& session, const std::vector<Question>& questions,
                               const std::vector<swiftlet::Pose>& poses) {
  Work all;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Reply reply = session.ask(questions[i], poses[i]);
    all.opened += reply.opened, all.looked_at += reply.looked_at;
    all.sum += reply.distance + reply.yes;
  }
  return all;
}

int main(int argc, char** argv) try {
  const bool with_fronts = argc > 1 && std::string(argv[1]) == "--front";
  if (with_fronts) --argc, ++argv;
  if (argc < 3) {
    std::fputs("swiftlet_mesh_count [--front] SCENE QUESTION [POSES [MESHES [FILE FILE]]]\nscenes:", stderr);
    for (const std::string& name : scene_names()) std::fprintf(stderr, " %s", name.c_str());
    std::fputs("\nquestions:", stderr);
    for (const Asked& asked : kAsked) std::fprintf(stderr, " %s", asked.name);
    return std::fputs("\n", stderr), 2;
  }
  const Asked* asked = asked_by_name(argv[2]);
  if (!asked) return std::fprintf(stderr, "no question is called %s\n", argv[2]), 2;
  swiftlet::set_width(swiftlet::Width::Two);  // valgrind 3.19 lacks an instruction of AVX that compilers make
  const std::optional<Scene> scene =
      make_scene(argv[1], argc > 4 ? argv[4] : "models/cache", argc > 3 ? std::atoi(argv[3]) : 200);
  if (!scene) return std::fputs("its mesh file is missing: models/fetch\n", stderr), 1;
  if (!asked->concerns(*scene)) return std::fprintf(stderr, "%s is not asked in this scene\n", asked->name), 2;
  const auto load = [](const char* file) {
    swiftlet::Result<swiftlet::MeshModel> model = swiftlet::load_mesh(file);
    if (!model) throw std::runtime_error(model.error().message);
    return std::move(model).value();
  };
  const auto session = argc > 6 ? swiftlet_session(load(argv[5]), load(argv[6]), with_fronts)
                                : swiftlet_session(scene->model_a, scene->model_b, with_fronts);
  std::vector<Question> questions;
  std::vector<swiftlet::Pose> poses;
  for (const swiftlet::Pose& pose : scene->poses) {
    const double truth = session->ask({}, pose).distance;
    if (!asked->concerns(truth)) continue;
    poses.push_back(pose);
    questions.push_back(asked->question(*scene, truth));
  }
  for (std::size_t i = 0; i < poses.size(); ++i) session->ask(questions[i], poses[i]);
  const Work all = ask_all(*session, questions, poses);
  const double n = double(poses.size());
  std::printf("queries %zu opened %.1f looked at %.1f sum %.17g\n", poses.size(), all.opened / n, all.looked_at / n, all.sum);
} catch (const std::exception& failure) {
  return std::fprintf(stderr, "%s\n", failure.what()), 1;
}
