// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Options whose argument is one of a few words.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace swiftlet::tool {

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// An option whose argument is one of a few words.
template <class Value>
void add_choice(CLI::App& word, const std::string& name, const Choices<Value>& choices, Value& value, const char* standard,
                const char* help) {
  std::string all;
  for (const auto& [key, ignored] : choices) all += (all.empty() ? "" : "|") + key;
  const auto read = [name, choices, all, &value](const std::string& text) {
    for (const auto& [key, meant] : choices) {
      if (key != text) continue;
      value = meant;
      return;
    }
    throw CLI::ValidationError(name, text + " is none of " + all);
  };
  word.add_option_function<std::string>(name, read, help)->type_name(all)->default_str(standard);
}

}  // namespace swiftlet::tool
