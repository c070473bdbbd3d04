// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A hull as other libraries want it, the support climb that those take which let the user write one, and what preparing costs.
// Knows ConvexView and no library. Inline throughout, so that a peer compiled for this very machine has its climb compiled so
// too.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "method.h"

namespace swiftlet::bench {

/// Bytes that malloc has given away, its chunk headers included; 0 where that is not known. Sees the C libraries too, and the
/// aligned blocks, which counting in `operator new` would not.
inline std::size_t heap_in_use() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 now = mallinfo2();
  return now.uordblks + now.hblkhd;
#else
  return 0;
#endif
}

/// Runs `prepare` and says what it took and left on the heap.
template <class Prepare>
Preparation measured(const Prepare& prepare) {
  const std::size_t bytes = heap_in_use();
  const auto begin = std::chrono::steady_clock::now();
  prepare();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const std::size_t now = heap_in_use();
  return {seconds.count(), now > bytes ? now - bytes : 0};
}

/// The faces' loops without diagonals, counter-clockwise seen from outside: per face its size, then its vertices. FCL's and
/// ODE's layout.
template <class Int>
std::vector<Int> face_loops(const ConvexView& view) {
  std::vector<Int> loops;
  for (std::uint32_t face = 0; face < view.face_first.size(); ++face) {
    const std::size_t size_at = loops.size();
    loops.push_back(0);
    for (const std::uint32_t v : FaceLoop(view, face)) loops.push_back(Int(v));
    loops[size_at] = Int(loops.size() - size_at - 1);
  }
  return loops;
}

/// Points and neighbours, diagonals included, so that no rounded face can trap a climb.
struct Graph {
  struct Node {
    double x, y, z;
    std::uint32_t ring_begin, ring_end;
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> ring;

  explicit Graph(const ConvexView& view) {
    ring.reserve(view.half_edges.size());
    for (const HalfEdge& h : view.half_edges) ring.push_back(h.head);
    nodes.reserve(view.vertices.size());
    for (const Vertex& v : view.vertices) nodes.push_back({v.x, v.y, v.z, v.ring_begin, v.ring_begin + v.ring_count});
  }
  std::size_t size() const { return nodes.size(); }
};

/// The support vertex by steepest ascent from the last one: O(1) for coherent directions, O(sqrt(n)) for others.
class Climber {
 public:
  explicit Climber(const Graph& graph) : graph_(&graph) {}
  const Graph::Node& support(double x, double y, double z) {
    const Graph::Node* const nodes = graph_->nodes.data();
    const std::uint32_t* const ring = graph_->ring.data();
    std::uint32_t best = last_, at;
    double most = x * nodes[best].x + y * nodes[best].y + z * nodes[best].z;
    do {
      at = best;
      for (std::uint32_t k = nodes[at].ring_begin; k < nodes[at].ring_end; ++k) {
        const Graph::Node& n = nodes[ring[k]];
        const double height = x * n.x + y * n.y + z * n.z;
        if (height > most) most = height, best = ring[k];
      }
    } while (best != at);
    last_ = best;
    return nodes[best];
  }
  void forget() { last_ = 0; }

 private:
  const Graph* graph_;
  std::uint32_t last_ = 0;
};

}  // namespace swiftlet::bench
