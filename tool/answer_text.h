// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Parts of answers as the tool writes them: statuses, verdicts, features by the user's ids. Knows nothing of files.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include <swiftlet/pose.h>
#include <swiftlet/query.h>

namespace swiftlet::tool {

using Json = nlohmann::ordered_json;

/// Null where the answer knows none.
Json json_of(const Vec3& v);
Json json_of(const Pose& pose);

const char* name(Status status);
const char* name(Verdict verdict);
/// The name, and what it means where that is not plain.
std::string in_words(Status status);

/// A feature and what the user calls it, which is known of an exact answer.
struct Witness {
  FeatureId feature;
  int level = 0;
  SourceFeature source;
  bool of_mesh = false;
};
std::string text_of(const Witness& w);
Json json_of(const Witness& w);

std::string hash_text(std::uint64_t hash);

}  // namespace swiftlet::tool
