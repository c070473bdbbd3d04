// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Where the stored cases lie.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace swiftlet::stability {

/// cases.json, then what generators found, by name. SWIFTLET_TEST_DATA is the folder tests/data.
inline std::vector<std::filesystem::path> suite_files() {
  const std::filesystem::path data = SWIFTLET_TEST_DATA;
  std::vector<std::filesystem::path> files{data / "cases.json"};
  if (std::filesystem::is_directory(data / "found")) {
    for (const auto& entry : std::filesystem::directory_iterator(data / "found")) {
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
  }
  std::sort(files.begin() + 1, files.end());
  return files;
}

}  // namespace swiftlet::stability
