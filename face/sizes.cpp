// SPDX-License-Identifier: MIT
#include "face/sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "face/bodies.h"
#include "face/tet_locator.h"
#include "kernel/formats/medit_sizes.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/from_chars.h"
#include "kernel/size_field.h"

namespace tetmend::face {

namespace {

using Spec = Sizes::Spec;

constexpr std::string_view kLabels = "label:";
constexpr std::string_view kArray = "array:";

OptionError wrong_size(std::string_view text, std::string_view reason) {
  return {"size", fmt::format("size: '{}' {}", text, reason)};
}

template <class Number>
std::optional<Number> to_number(std::string_view text) {
  Number number{};
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Takes "label:1,4=" off the front.
std::vector<Label> take_labels(std::string_view whole, std::string_view& rest) {
  std::vector<Label> labels;
  if (!rest.starts_with(kLabels)) return labels;
  const std::size_t equals = rest.find('=');
  if (equals == std::string_view::npos) {
    throw wrong_size(whole, "has no '=' behind its label: expected label:3=0.2");
  }
  std::string_view list = rest.substr(kLabels.size(), equals - kLabels.size());
  rest.remove_prefix(equals + 1);
  for (;;) {
    const std::string_view word = list.substr(0, list.find(','));
    const auto label = to_number<Label>(word);
    if (!label) throw wrong_size(whole, fmt::format("has '{}' for a label: no number", word));
    labels.push_back(*label);
    if (word.size() == list.size()) return labels;
    list.remove_prefix(word.size() + 1);
  }
}

Spec read_spec(const std::string& text) {
  Spec spec{.text = text, .file = {}, .name = {}, .function = {}, .labels = {}};
  std::string_view rest = text;
  spec.labels = take_labels(text, rest);
  const std::filesystem::path path = std::string(rest);
  if (rest.starts_with(kArray)) {
    spec.kind = Spec::Kind::array;
    spec.name = rest.substr(kArray.size());
    if (spec.name.empty()) throw wrong_size(text, "names no array");
    return spec;
  }
  if (path.extension() == ".sol" || path.extension() == ".solb") {
    spec.kind = Spec::Kind::file;
    spec.file = rest;
    return spec;
  }
  if (path.extension() == ".lua") {
    spec.kind = Spec::Kind::function;
    spec.file = rest;
    spec.function = std::make_shared<const LuaFunction>(path, "size");
    return spec;
  }
  if (const auto colon = rest.rfind(':'); colon != std::string_view::npos) {
    spec.kind = Spec::Kind::background;
    spec.file = rest.substr(0, colon);
    spec.name = rest.substr(colon + 1);
    if (std::filesystem::path(spec.file).has_extension() && !spec.name.empty()) return spec;
  }
  if (!rest.empty() && rest.back() == 'x') {
    spec.kind = Spec::Kind::factor;
    rest.remove_suffix(1);
  }
  const auto number = to_number<double>(rest);
  if (!number) {
    throw wrong_size(
        text,
        "is no size: expected a length such as 0.5, a factor such as 0.5x, array:NAME, "
        "a file FILE.sol or FILE.solb, a function size(x, y, z) in FILE.lua, or MESH:NAME, an "
        "array "
        "of another mesh, and label:L= before it for a region");
  }
  if (!(std::isfinite(*number) && *number > 0)) throw wrong_size(text, "is not above 0");
  spec.number = *number;
  return spec;
}

/// The values of an array of the points.
std::vector<double> values_of(const MeshData& data, const Spec& spec) {
  const auto array = std::find_if(data.point_data.begin(), data.point_data.end(),
                                  [&](const DataArray& each) { return each.name == spec.name; });
  if (array == data.point_data.end()) {
    std::string names;
    for (const DataArray& each : data.point_data) {
      names += (names.empty() ? "" : ", ") + each.name;
    }
    throw wrong_size(spec.text, fmt::format("names no array of the points; there {}",
                                            names.empty() ? "is none" : "are: " + names));
  }
  if (array->components != 1) {
    throw wrong_size(spec.text, fmt::format("has {} numbers at each point: expected one, a length",
                                            array->components));
  }
  return std::visit(
      [](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
      array->values);
}

/// Present lengths by point of `data`; 0 for a point of no tet.
std::vector<double> present_lengths(const MeshData& data, const TetMesh& mesh) {
  std::vector<double> by_point(data.points.size(), 0);
  const std::vector<double> lengths = local_lengths(mesh);
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const std::uint32_t number = mesh.origin(VertexHandle(i));
    if (number != TetMesh::kNotFromFile) by_point[number] = lengths[i];
  }
  return by_point;
}

/// Points of tets in a region, by point; all of them where the size is for everywhere.
std::vector<char> points_in(const MeshData& data, const Spec& spec) {
  std::vector<char> are_in(data.points.size(), 0);
  std::vector<Label> missing = spec.labels;
  for (const MeshData::Tet& tet : data.tets) {
    if (!spec.labels.empty()) {
      if (std::find(spec.labels.begin(), spec.labels.end(), tet.label) == spec.labels.end()) {
        continue;
      }
      std::erase(missing, tet.label);
    }
    for (const std::uint32_t v : tet.vertices) are_in[v] = 1;
  }
  if (!missing.empty()) {
    throw wrong_size(spec.text, fmt::format("is for label {}, but no tet has it", missing.front()));
  }
  return are_in;
}

/// Neighbours of points along edges of tets.
struct Neighbours {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> points;

  explicit Neighbours(const MeshData& data) {
    std::vector<std::uint64_t> pairs;
    pairs.reserve(data.tets.size() * 12);
    for (const MeshData::Tet& tet : data.tets) {
      for (const std::uint32_t a : tet.vertices) {
        for (const std::uint32_t b : tet.vertices) {
          if (a != b) pairs.push_back(std::uint64_t{a} << 32 | b);
        }
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    begin.assign(data.points.size() + 1, 0);
    points.reserve(pairs.size());
    for (const std::uint64_t pair : pairs) {
      ++begin[(pair >> 32) + 1];
      points.push_back(static_cast<std::uint32_t>(pair));
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  }
};

/// Lowers lengths until they grow by no more than `rate` times the distance along any edge.
void grade(const MeshData& data, double rate, std::vector<double>& lengths) {
  const Neighbours neighbours(data);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < lengths.size(); ++v) {
    if (neighbours.begin[v] < neighbours.begin[v + 1]) queue.emplace(lengths[v], v);
  }
  while (!queue.empty()) {
    const auto [length, v] = queue.top();
    queue.pop();
    if (length > lengths[v]) continue;
    for (std::uint32_t k = neighbours.begin[v]; k < neighbours.begin[v + 1]; ++k) {
      const std::uint32_t w = neighbours.points[k];
      const double most = length + rate * (data.points[v] - data.points[w]).norm();
      if (most >= lengths[w]) continue;
      lengths[w] = most;
      queue.emplace(most, w);
    }
  }
}

/// Lengths that are linear in the tets of a mesh.
class LinearLengths {
 public:
  LinearLengths(const MeshData& data, std::vector<double> lengths)
      : data_(data),
        lengths_(std::move(lengths)),
        bodies_(data),
        locator_(data, bodies_, all(data)) {}

  double at(const Point& place) const {
    const TetPlace found = locator_.find_roughly(place);
    const auto& v = data_.tets[found.tet].vertices;
    double least = lengths_[v[0]];
    double most = least;
    double length = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      length += found.weights[i] * lengths_[v[i]];
      least = std::min(least, lengths_[v[i]]);
      most = std::max(most, lengths_[v[i]]);
    }
    return std::clamp(length, least, most);  // a place may lie beside the tet
  }
  /// How steep they are at most, over the way; amply, for edges of tets are seldom as steep as the tets.
  double steepest() const {
    constexpr double kAmple = 1.5;
    double steepest = 0;
    for (const MeshData::Tet& tet : data_.tets) {
      for (const auto& [i, j] : kEdgeVertices) {
        const std::uint32_t v = tet.vertices[i];
        const std::uint32_t w = tet.vertices[j];
        const double way = (data_.points[v] - data_.points[w]).norm();
        const double change = std::abs(lengths_[v] - lengths_[w]);
        if (change > steepest * way) steepest = change / way;
      }
    }
    return kAmple * steepest;
  }

 private:
  static std::vector<std::uint32_t> all(const MeshData& data) {
    std::vector<std::uint32_t> tets(data.tets.size());
    for (std::uint32_t i = 0; i < tets.size(); ++i) tets[i] = i;
    return tets;
  }

  const MeshData& data_;
  std::vector<double> lengths_;
  Bodies bodies_;
  TetLocator locator_;
};

/// @param largest 0: none
double clamped(double length, double smallest, double largest) {
  length = std::max(length, smallest);
  return largest > 0 ? std::min(length, largest) : length;
}

/// @throws Error as that does, with the place
double call(const LuaFunction& function, const Point& at) {
  try {
    return function(std::array{at.x(), at.y(), at.z()});
  } catch (const Error& error) {
    throw Error(fmt::format("{}, at ({:g}, {:g}, {:g})", error.what(), at.x(), at.y(), at.z()));
  }
}

/// @throws Error for a length that is none; `length` as the file has it
void check_length(const Spec& spec, std::size_t point, double length) {
  if (std::isfinite(length) && length > 0) return;
  throw Error(fmt::format("{}: point {} has the size {:g}: expected a number above 0", spec.text,
                          point, length));
}

/// Another mesh with an array of lengths, in the lengths that ours is worked with.
class Background {
 public:
  /// @param clamped a length of the file within its bounds
  /// @param rate of growth, see grade(); 0: lengths grow as they like
  Background(const Spec& spec, const Scale& scale, const std::function<double(double)>& clamped,
             double rate)
      : data_(mesh_of(spec)), lengths_(data_, in_work(spec, scale, clamped, rate)) {}
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  double at(const Point& place) const { return lengths_.at(place); }
  double steepest() const { return lengths_.steepest(); }

 private:
  static MeshData mesh_of(const Spec& spec) {
    MeshData data = read_mesh(spec.file);
    if (data.tets.empty()) throw Error(fmt::format("{}: has no linear tets", spec.file));
    return data;
  }
  std::vector<double> in_work(const Spec& spec, const Scale& scale,
                              const std::function<double(double)>& clamped, double rate) {
    std::vector<double> lengths = values_of(data_, spec);
    for (const MeshData::Tet& tet : data_.tets) {
      for (const std::uint32_t v : tet.vertices) check_length(spec, v, lengths[v]);
    }
    for (double& length : lengths) length = scale.to_work(clamped(length));
    scale.to_work(data_.points);
    if (rate > 0) grade(data_, rate, lengths);
    return lengths;
  }

  MeshData data_;
  LinearLengths lengths_;
};

/// What a size says for each point.
std::vector<double> lengths_of(const Spec& spec, const MeshData& data, const TetMesh& mesh) {
  std::vector<double> lengths;
  switch (spec.kind) {
    case Spec::Kind::constant:
      return std::vector<double>(data.points.size(), mesh.scale().to_work(spec.number));
    case Spec::Kind::factor:
      lengths = present_lengths(data, mesh);
      for (double& length : lengths) length *= spec.number;
      return lengths;
    case Spec::Kind::array:
      lengths = values_of(data, spec);
      break;
    case Spec::Kind::file:
      lengths = formats::read_medit_sizes(spec.file);
      break;
    case Spec::Kind::function:
      for (const Point& p : data.points) {
        lengths.push_back(call(*spec.function, mesh.scale().to_file(p)));
      }
      break;
    case Spec::Kind::background: {
      const Background background(
          spec, mesh.scale(), [](double length) { return length; }, 0);
      for (const Point& p : data.points) lengths.push_back(background.at(p));
      return lengths;
    }
  }
  if (lengths.size() != data.points.size()) {
    throw Error(fmt::format("{}: {} lengths for {} points",
                            spec.file.empty() ? spec.text : spec.file, lengths.size(),
                            data.points.size()));
  }
  for (double& length : lengths) length = mesh.scale().to_work(length);
  return lengths;
}

}  // namespace

Sizes::Sizes(const Options& options)
    : function_(options.size_at),
      gradation_(options.gradation),
      smallest_(options.smallest),
      largest_(options.largest) {
  for (const std::string& text : options.size) specs_.push_back(read_spec(text));
  if (!(gradation_ == 0 || (gradation_ > 1 && std::isfinite(gradation_)))) {
    throw OptionError("gradation",
                      fmt::format("gradation: {:g} is neither 0 nor above 1", gradation_));
  }
  if (!(smallest_ >= 0 && std::isfinite(smallest_))) {
    throw OptionError("smallest", fmt::format("smallest: {:g} is no length", smallest_));
  }
  if (!(largest_ >= 0) || (largest_ > 0 && largest_ < smallest_)) {
    throw OptionError(
        "largest", fmt::format("largest: {:g} is less than smallest, {:g}", largest_, smallest_));
  }
  if (!are_wanted()) return;
  if (function_ && !specs_.empty()) {
    throw OptionError("size_at",
                      "size_at: the lengths come from a function or from size, not both");
  }
  if ((function_ || is_alone(Spec::Kind::function)) && gradation_ != Options().gradation) {
    throw OptionError("gradation",
                      "gradation: the lengths of a function are taken as they are; a function that "
                      "changes less does what gradation would");
  }
  if (options.keep_size) {
    throw OptionError("keep_size", "keep_size: the lengths are those of size, or those there were");
  }
}

double Sizes::clamped(double length) const {
  return face::clamped(length, smallest_, largest_);
}

bool Sizes::is_alone(Spec::Kind kind) const {
  return specs_.size() == 1 && specs_[0].kind == kind && specs_[0].labels.empty();
}

std::shared_ptr<const WantedLengths> Sizes::field_of(Function function, std::string name,
                                                     const Scale& scale) const {
  const auto within = [smallest = smallest_, largest = largest_](double length) {
    return face::clamped(length, smallest, largest);
  };
  return std::make_shared<WantedLengths>(
      [function = std::move(function), name = std::move(name), within, scale](const Point& place) {
        const Point at = scale.to_file(place);
        const double length = function(at.x(), at.y(), at.z());
        if (!(std::isfinite(length) && length > 0)) {
          throw Error(fmt::format("{}: {:g} at ({:g}, {:g}, {:g}) is no length", name, length,
                                  at.x(), at.y(), at.z()));
        }
        return scale.to_work(within(length));
      });
}

std::string Sizes::of_mesh() const {
  using Kind = Spec::Kind;
  const bool are_of_places = specs_.empty() || is_alone(Kind::constant) ||
                             is_alone(Kind::function) || is_alone(Kind::background);
  return are_of_places ? std::string() : specs_.back().text;
}

std::shared_ptr<const WantedLengths> Sizes::field_of_places() const {
  return field_of_places(Scale());
}

/// Null: the lengths are of the mesh.
std::shared_ptr<const WantedLengths> Sizes::field_of_places(const Scale& scale) const {
  if (function_) return field_of(function_, "size_at", scale);
  if (is_alone(Spec::Kind::function)) {
    const auto by_script = [function = specs_[0].function](double x, double y, double z) {
      return call(*function, Point(x, y, z));
    };
    return field_of(by_script, specs_[0].text, scale);
  }
  if (is_alone(Spec::Kind::constant)) {
    return std::make_shared<WantedLengths>(scale.to_work(clamped(specs_[0].number)));
  }
  if (!is_alone(Spec::Kind::background)) return nullptr;
  const auto within = [this](double length) { return clamped(length); };
  const auto background = std::make_shared<const Background>(specs_[0], scale, within, rate());
  return std::make_shared<WantedLengths>(
      [background](const Point& place) { return background->at(place); }, background->steepest());
}

std::shared_ptr<const WantedLengths> Sizes::field(const MeshData& data, const TetMesh& mesh) const {
  const Scale& scale = mesh.scale();
  if (auto of_places = field_of_places(scale)) return of_places;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> lengths(data.points.size(), kNone);
  // Sizes for everywhere first; where several regions meet, the least counts.
  for (const bool everywhere : {true, false}) {
    std::vector<double> of_regions(lengths.size(), kNone);
    for (const Spec& spec : specs_) {
      if (spec.labels.empty() != everywhere) continue;
      const std::vector<double> wanted = lengths_of(spec, data, mesh);
      const std::vector<char> are_in = points_in(data, spec);
      for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (are_in[i] == 0) continue;
        check_length(spec, i, scale.to_file(wanted[i]));
        of_regions[i] = std::min(of_regions[i], wanted[i]);
      }
    }
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (of_regions[i] < kNone) lengths[i] = of_regions[i];
    }
  }
  const std::vector<double> present = present_lengths(data, mesh);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] == kNone) lengths[i] = present[i];
    lengths[i] = scale.to_work(clamped(scale.to_file(lengths[i])));
  }
  if (rate() > 0) grade(data, rate(), lengths);
  auto linear = std::make_shared<const LinearLengths>(data, std::move(lengths));
  return std::make_shared<WantedLengths>([linear](const Point& place) { return linear->at(place); },
                                         linear->steepest());
}

}  // namespace tetmend::face
