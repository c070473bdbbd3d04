// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a build's watch throws, and on which thread.
#include "watch.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace swiftlet::lod {
namespace {

/// Works until half is done, where the callback ends the build, then on another thread, which must not hide why.
template <class Thrown>
void expect_on_every_thread(const Progress& progress) {
  Watch watch(progress);
  watch.begin("stage", 1, 100);
  EXPECT_NO_THROW(std::thread([&] { watch.work(40); }).join());
  EXPECT_THROW(watch.work(20), Thrown);
  for (int i = 0; i < 2; ++i) std::thread([&] { EXPECT_THROW(watch.work(), Thrown); }).join();
}

TEST(Watch, WhatTheCallbackThrowsIsThrownOnEveryThread) {
  expect_on_every_thread<std::runtime_error>([](double done, std::string_view) {
    if (done > 0.5) throw std::runtime_error("enough");
    return true;
  });
}

TEST(Watch, CancelsOnEveryThread) {
  expect_on_every_thread<Cancelled>([](double done, std::string_view) { return done < 0.5; });
}

}  // namespace
}  // namespace swiftlet::lod
