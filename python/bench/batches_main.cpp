// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The batch over poses in C++, which batches.py times itself beside: swiftlet_python_bench A.swl B.swl POSES THREADS ROUNDS,
// where POSES is a file of 16 doubles per pose. Prints for each round the nanoseconds per query, with new room for the answers
// as Python makes it, and into room that is there; then a hash of all intervals.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include <swiftlet/batch.h>
#include <swiftlet/model_file.h>

int main(int argc, char** argv) {
  using namespace swiftlet;
  if (argc != 6) return std::fputs("usage: swiftlet_python_bench A.swl B.swl POSES THREADS ROUNDS\n", stderr), 2;
  const Result<Model> a = load(argv[1]), b = load(argv[2]);
  if (!a || !b) return std::fputs("cannot read the models\n", stderr), 1;
  std::ifstream file(argv[3], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<Pose> poses(bytes.size() / (16 * sizeof(double)));
  for (std::size_t n = 0; n < poses.size(); ++n) {
    double m[16];
    std::memcpy(m, bytes.data() + n * sizeof m, sizeof m);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) poses[n].rotation(i, j) = m[4 * i + j];
      poses[n].translation[i] = m[4 * i + 3];
    }
  }
  const Run run{on_threads(unsigned(std::atoi(argv[4])))};
  std::vector<Answer> answers;
  for (int round = 0; round < std::atoi(argv[5]); ++round) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Answer> made(poses.size());
    distance(a.value(), b.value(), poses, made, {}, run);
    const auto middle = std::chrono::steady_clock::now();
    distance(a.value(), b.value(), poses, made, {}, run);
    const auto per_query = [&](auto time) {
      return std::chrono::duration<double, std::nano>(time).count() / double(poses.size());
    };
    std::printf("%.1f %.1f\n", per_query(middle - begin), per_query(std::chrono::steady_clock::now() - middle));
    answers.swap(made);
  }
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Answer& answer : answers) {
    for (const double x : {answer.lower, answer.upper}) {
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3u;
    }
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(hash));
}
