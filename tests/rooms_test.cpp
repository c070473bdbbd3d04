// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The order of the house, read off its includes: arrows between the rooms of march run one way, folders stand in no circle, and
// march/README.md names every source file in its room. And its pages: the first is short, and no link leads nowhere.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kRoot = fs::path(SWIFTLET_TEST_DIR).parent_path();
const Names kFolders{"lut", "march", "bvh", "scene", "c", "lod", "tool", "adapters", "python", "yardstick", "bench", "tests"};

/// What a room may include beside itself.
const std::map<std::string, Names> kBelow{
    {"numeric", {}},
    {"body", {"numeric"}},
    {"pair", {"numeric", "body"}},
    {"query", {"numeric", "body", "pair"}},
    {"depth", {"numeric", "body", "pair", "query"}},
    {"manifold", {"numeric", "body", "pair", "query", "depth"}},
    {"make", {"numeric", "body", "pair"}},
    {"check", {"numeric", "body", "pair", "query", "depth", "manifold", "make"}},
};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path kind = entry.path().extension();
    if (kind == ".cpp" || kind == ".h") found.push_back(entry.path());
  }
  return found;
}

/// What stands between two marks, wherever that is.
std::vector<std::string> between(const std::string& text, const std::string& open, char close) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
    const std::size_t begin = at + open.size();
    found.push_back(text.substr(begin, text.find(close, begin) - begin));
  }
  return found;
}

/// The headers that a file names, in quotes or in angle brackets.
std::vector<std::string> includes(const fs::path& path, char open, char close) {
  return between(text_of(path), std::string("#include ") + open, close);
}

TEST(Rooms, IncludesRunOneWay) {
  std::size_t arrows = 0;
  for (const auto& [room, below] : kBelow) {
    for (const fs::path& file : sources(kRoot / "march" / room)) {
      for (const std::string& header : includes(file, '"', '"')) {
        const std::string to = header.substr(0, header.find('/'));
        EXPECT_TRUE(fs::exists(kRoot / "march" / header)) << file << " includes " << header << " without its room";
        EXPECT_TRUE(to == room || below.count(to)) << file << " includes " << header;
        arrows += to != room;
      }
    }
  }
  EXPECT_GE(arrows, 80u);
  for (const fs::path& file : sources(kRoot / "march")) {
    const std::string room = file.lexically_relative(kRoot / "march").begin()->string();
    EXPECT_TRUE(room == "include" || kBelow.count(room)) << file << " is in no room";
  }
}

TEST(Rooms, ReadmeNamesEverySource) {
  const std::string readme = text_of(kRoot / "march/README.md");
  for (const auto& [room, below] : kBelow) {
    const std::size_t begin = readme.find("### `" + room + "/`");
    ASSERT_NE(begin, std::string::npos) << room;
    const std::string section = readme.substr(begin, readme.find("\n##", begin + 1) - begin);
    for (const fs::path& file : sources(kRoot / "march" / room)) {
      const std::string name = file.filename().string(), both = file.stem().string() + ".*";
      EXPECT_TRUE(section.find('`' + name + '`') != std::string::npos || section.find('`' + both + '`') != std::string::npos)
          << room << "/" << name;
    }
  }
}

/// Folders by the headers that they hold; those of a consumer are its own.
std::map<std::string, Names> holders() {
  std::map<std::string, Names> found;
  for (const std::string& folder : kFolders) {
    for (const fs::path& file : sources(kRoot / folder)) {
      if (file.extension() != ".h" || file.generic_string().find("/consumer/") != std::string::npos) continue;
      const std::string path = file.generic_string();
      const std::size_t is_public = path.find("/include/");
      found[is_public == std::string::npos ? file.filename().string() : path.substr(is_public + 9)].insert(folder);
    }
  }
  return found;
}

TEST(Folders, StandInNoCircle) {
  const std::map<std::string, Names> holder = holders();
  std::map<std::string, Names> arrows;
  for (const std::string& folder : kFolders) {
    for (const fs::path& file : sources(kRoot / folder)) {
      if (file.generic_string().find("/consumer/") != std::string::npos) continue;
      std::vector<std::string> named = includes(file, '"', '"'), others = includes(file, '<', '>');
      named.insert(named.end(), others.begin(), others.end());
      for (const std::string& header : named) {
        const bool is_public = header.starts_with("swiftlet/");
        const auto found = holder.find(is_public ? header : fs::path(header).filename().string());
        if (found == holder.end() || found->second.count(folder)) continue;
        for (const std::string& other : found->second) arrows[folder].insert(other);
      }
    }
  }
  EXPECT_TRUE(arrows["lod"].count("march") && arrows["tests"].count("lod")) << "no includes were found";
  std::vector<std::string> way;
  Names done;
  const std::function<void(const std::string&)> visit = [&](const std::string& folder) {
    if (const auto again = std::find(way.begin(), way.end(), folder); again != way.end()) {
      std::string circle;
      for (auto step = again; step != way.end(); ++step) circle += *step + " > ";
      ADD_FAILURE() << circle << folder;
      return;
    }
    if (!done.insert(folder).second) return;
    way.push_back(folder);
    for (const std::string& other : arrows[folder]) visit(other);
    way.pop_back();
  };
  for (const std::string& folder : kFolders) visit(folder);
}

TEST(Pages, TheFirstIsShort) {
  const std::string readme = text_of(kRoot / "README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 150);
}

TEST(Pages, LinksLeadToFiles) {
  std::vector<fs::path> pages;
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot)) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  for (const char* folder : {"march", "bvh", "scene", "c", "lod", "adapters", "python", "yardstick", "tests", "tests/stability",
                             "bench", "models", "packaging"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(kRoot / folder)) {
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
  }
  int links = 0;
  for (const fs::path& page : pages) {
    for (const std::string& link : between(text_of(page), "](", ')')) {
      const std::string to = link.substr(0, link.find('#'));
      if (to.empty() || to.find_first_of(" :") != std::string::npos) continue;  // a lambda, or a page elsewhere
      EXPECT_TRUE(fs::exists(page.parent_path() / to)) << page << " leads to " << to;
      ++links;
    }
  }
  EXPECT_GE(links, 30);
}

}  // namespace
