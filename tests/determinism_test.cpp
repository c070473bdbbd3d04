// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The answers of today are those that were recorded, bit for bit. `./run determinism` compares more of them between compilers.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "answers.h"
#include "numeric/width.h"

namespace swiftlet {
namespace {

using answers::Record;

/// The first of many, each on its line.
std::string some(const std::vector<std::string>& lines) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(lines.size(), kShown); ++i) text += "\n  " + lines[i];
  return text;
}
std::string counts(const std::map<std::string, int>& fields) {
  std::string text;
  for (const auto& [name, count] : fields) text += "\n  " + name + " in " + std::to_string(count) + " records";
  return text;
}

TEST(Determinism, AnswersAreTheRecordedOnes) {
  std::ifstream file(SWIFTLET_TEST_DIR "/data/answers.txt");
  const std::vector<Record> recorded = answers::read(file),
                            today =
                                answers::records(answers::models(SWIFTLET_TEST_DIR "/data/models"), answers::kRecordedRounds);
  ASSERT_GT(recorded.size(), 1000u);
  const answers::Changes changes = answers::compare(recorded, today);
  EXPECT_TRUE(changes.empty())
      << "Of all answers these changed:" << some(changes.hashes) << "\nof the sample " << changes.values.size()
      << " fields:" << some(changes.values) << "\nthese fields are gone:" << counts(changes.gone)
      << "\nthese are new:" << counts(changes.added)
      << "\nIf that is meant, `build/bin/swiftlet_determinism --record` renews tests/data/answers.txt.";
}

TEST(Determinism, RegistersOfTwoAndOfFourGiveTheSameAnswers) {
  const std::vector<Model> models = answers::models(SWIFTLET_TEST_DIR "/data/models");
  if (!set_width(Width::Four)) GTEST_SKIP() << "walks know one width here";
  const std::vector<Record> by_four = answers::records(models, answers::kRecordedRounds);
  ASSERT_TRUE(set_width(Width::Two));
  const answers::Changes changes = answers::compare(by_four, answers::records(models, answers::kRecordedRounds));
  set_width(Width::Four);
  EXPECT_TRUE(changes.empty()) << some(changes.hashes) << some(changes.values);
}

TEST(Determinism, ARecordIsReadAsItWasWritten) {
  const std::vector<Record> records{{"a/0-1/2/warm", {{"lower", "0x1.8p+1"}, {"normal", "0x0p+0,-0x0p+0,nan"}}}, {"b", {}}};
  std::stringstream file;
  answers::write(records, file);
  EXPECT_EQ(file.str(), "a/0-1/2/warm lower=0x1.8p+1 normal=0x0p+0,-0x0p+0,nan\nb\n");
  const std::vector<Record> read = answers::read(file);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].name, "a/0-1/2/warm");
  EXPECT_EQ(read[0].fields, records[0].fields);
  EXPECT_EQ(read[1].name, "b");
}

TEST(Determinism, ChangesAreNamedFieldByField) {
  const std::vector<Record> was{{"fields/answers", {{"lower", "e"}, {"upper", "f"}}},
                                {"distance/0-1/2/warm", {{"lower", "1"}, {"upper", "2"}, {"proof", "0"}}}},
      is{{"fields/answers", {{"lower", "e"}, {"upper", "a"}}},
         {"distance/0-1/2/warm", {{"lower", "1"}, {"upper", "3"}, {"radius", "0"}}},
         {"distance/0-1/3/warm", {{"radius", "1"}}}};
  const answers::Changes changes = answers::compare(was, is);
  EXPECT_EQ(changes.hashes, std::vector<std::string>{"fields/answers upper"});
  EXPECT_EQ(changes.values, std::vector<std::string>{"distance/0-1/2/warm upper=3, recorded 2"});
  EXPECT_EQ(changes.gone, (std::map<std::string, int>{{"proof", 1}}));
  EXPECT_EQ(changes.added, (std::map<std::string, int>{{"radius", 2}}));
  EXPECT_TRUE(answers::compare(was, was).empty());
}

}  // namespace
}  // namespace swiftlet
