// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pose_text.h"

#include <Eigen/LU>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "body/file.h"
#include "pair/pair_view.h"
#include "text.h"

namespace swiftlet::tool {
namespace {

Error bad_pose(const std::string& text, const std::string& why) {
  return {ErrorCode::BadValue, "the pose " + text + " " + why};
}

/// What a text that ought to hold numbers holds.
struct Numbers {
  std::vector<double> values;
  std::string beyond;        ///< the first that no double is near
  bool only_numbers = true;  ///< `values` is all there is
  std::string word{};        ///< else the first that is no number,
  std::size_t line = 1;      ///< and the line it stands on
};

constexpr std::size_t kMostShown = 40;  ///< characters of a word, in a message

/// Between any two numbers stand blanks or a comma.
Numbers read_numbers(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::string_view whole = text;
  Numbers read;
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size())); };
  for (skip_blanks(); !text.empty(); skip_blanks()) {
    if (!read.values.empty() && text.front() == ',') text.remove_prefix(1), skip_blanks();
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n,"));
    if (text.starts_with('+')) text.remove_prefix(1);
    const ReadNumber next = read_number(text);
    if (next.is_beyond && read.beyond.empty()) read.beyond = text.substr(0, next.length);
    text.remove_prefix(next.length);
    read.only_numbers = next.length > 0 && (text.empty() || text.front() == ',' || kBlank.find(text.front()) != kBlank.npos);
    if (!read.only_numbers) {
      read.word = word.substr(0, kMostShown);
      for (char& c : read.word)
        if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
      read.line += std::size_t(std::count(whole.data(), word.data(), '\n'));
      break;
    }
    read.values.push_back(next.value);
  }
  return read;
}

bool all_finite(const std::vector<double>& values) {
  for (double value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

/// The rotation of the quaternion w + xi + yj + zk, which need not be a unit one.
std::optional<Mat3> rotation(double w, double x, double y, double z) {
  const double largest = std::max({std::fabs(w), std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!(largest > 0)) return std::nullopt;
  w /= largest, x /= largest, y /= largest, z /= largest;
  const double s = 2 / (w * w + x * x + y * y + z * z);
  Mat3 r;
  r << 1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),  //
      s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w),   //
      s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y);
  return r;
}

Error beyond_range(const std::string& name, const Numbers& read) {
  return bad_pose(name, "holds " + read.beyond + ", which is beyond the range of doubles");
}

/// The pose, or why no query takes it. `name` is what the user calls it.
Result<Pose> legal(const std::string& name, const Pose& pose) {
  if (!(pose.translation.cwiseAbs().maxCoeff() <= kMostCoordinate))
    return bad_pose(name, "translates by more than " + number(kMostCoordinate));
  const PoseQuality quality = pose_quality(motion(pose));
  if (!quality.legal)
    return bad_pose(
        name, "is not orthonormal: an entry of R^T R is off by " + format("%.3g", quality.error) + ", and 1e-6 is allowed");
  if (pose.rotation.determinant() < 0) return bad_pose(name, "is a mirror image, not a rotation");
  return pose;
}

Result<Pose> typed_pose(const std::string& text, const std::vector<double>& values) {
  if (values.size() != 3 && values.size() != 7)
    return bad_pose(text, "has " + std::to_string(values.size()) + " numbers; x,y,z has 3 and x,y,z,qw,qx,qy,qz has 7");
  if (!all_finite(values)) return bad_pose(text, "is not finite");
  Pose pose;
  pose.translation = Vec3(values[0], values[1], values[2]);
  if (values.size() == 3) return legal(text, pose);
  const std::optional<Mat3> turned = rotation(values[3], values[4], values[5], values[6]);
  if (!turned) return bad_pose(text, "has a zero quaternion");
  pose.rotation = *turned;
  return legal(text, pose);
}

Result<Pose> pose_of_text(const std::string& path, std::string_view text) {
  const Numbers read = read_numbers(text);
  const std::vector<double>& values = read.values;
  if (!read.only_numbers)
    return bad_pose(path, "holds \"" + read.word + "\" in line " + std::to_string(read.line) + ", which is no number");
  if (!read.beyond.empty()) return beyond_range(path, read);
  if (values.size() != 12) return bad_pose(path, "holds " + std::to_string(values.size()) + " numbers; a row-major 3x4 has 12");
  if (!all_finite(values)) return bad_pose(path, "is not finite");
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.rotation(row, column) = values[std::size_t(4 * row + column)];
    pose.translation[row] = values[std::size_t(4 * row + 3)];
  }
  return legal(path, pose);
}

Result<Pose> filed_pose(const std::string& path) {
  const Result<OwnedBytes> file = map_file(path_of(path));
  if (!file) return file.error();
  const auto& [owner, bytes] = file.value();
  const Result<Pose> pose = pose_of_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (pose) return pose;
  Error error = pose.error();
  error.file = path;
  return error;
}

}  // namespace

Result<Pose> read_pose(const std::string& text) {
  std::error_code ignored;
  if (const Numbers read = read_numbers(text); read.only_numbers && !read.values.empty())
    return read.beyond.empty() ? typed_pose(text, read.values) : beyond_range(text, read);
  const std::filesystem::path path = path_of(text);
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_regular_file(status)) return filed_pose(text);
  if (std::filesystem::exists(status)) return named(path, {ErrorCode::CannotRead, "is no regular file"});
  return bad_pose("\"" + text + "\"", "is neither x,y,z nor x,y,z,qw,qx,qy,qz nor a file");
}

}  // namespace swiftlet::tool
