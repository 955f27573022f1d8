// SPDX-License-Identifier: MIT
#include "kernel/formats/lsdyna_nodes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>

#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

namespace {

constexpr std::uint32_t bits(std::initializer_list<unsigned> fields) {
  std::uint32_t mask = 0;
  for (const unsigned field : fields) mask |= 1U << field;
  return mask;
}

std::int64_t whole(std::span<const std::string_view> fields, std::size_t i) {
  std::int64_t number = 0;
  if (i >= fields.size() || !nastran_integer(fields[i], number)) return 0;
  return number;
}

/// Rotation about an axis beside the node, or relative to two others.
bool is_motion_longer(std::span<const std::string_view> fields) {
  const std::int64_t freedom = std::abs(whole(fields, 1));
  return (freedom >= 9 && freedom <= 11) || whole(fields, 2) == 4;
}
/// Of six or eight nodes.
bool is_segment_longer(std::span<const std::string_view> fields) {
  return whole(fields, 7) > 0;
}

constexpr std::uint32_t kShell = bits({2, 3, 4, 5, 6, 7, 8, 9});
constexpr std::uint32_t kJoint = bits({0, 1, 2, 3, 4, 5});

using Form = LsDynaNodeFields::Form;

constexpr auto kForms = std::to_array<Form>({
    {"BOUNDARY_PRESCRIBED_MOTION_NODE", bits({0}), 1, bits({3, 4}), &is_motion_longer},
    {"BOUNDARY_SPC_NODE", bits({0})},
    {"BOUNDARY_SPC_NODE_BIRTH_DEATH", bits({0}), 2},
    {"BOUNDARY_TEMPERATURE_NODE", bits({0})},
    {"CONSTRAINED_EXTRA_NODES_NODE", bits({1})},
    {"CONSTRAINED_EXTRA_NODES_SET", 0},
    {"CONSTRAINED_JOINT_CYLINDRICAL", kJoint},
    {"CONSTRAINED_JOINT_LOCKING", kJoint},
    {"CONSTRAINED_JOINT_PLANAR", kJoint},
    {"CONSTRAINED_JOINT_REVOLUTE", kJoint},
    {"CONSTRAINED_JOINT_SPHERICAL", kJoint},
    {"CONSTRAINED_JOINT_TRANSLATIONAL", kJoint},
    {"CONSTRAINED_JOINT_UNIVERSAL", kJoint},
    {"CONSTRAINED_NODAL_RIGID_BODY", bits({3})},
    {"CONSTRAINED_NODAL_RIGID_BODY_SPC", bits({3}), 2},
    {"CONSTRAINED_NODE_SET", 0},
    {"CONSTRAINED_RIGID_BODIES", 0},
    {"CONSTRAINED_RIVET", bits({0, 1})},
    {"CONSTRAINED_SPOTWELD", bits({0, 1})},
    {"DATABASE_HISTORY_NODE_LOCAL", bits({0})},
    {"DATABASE_NODAL_FORCE_GROUP", 0},
    {"DEFINE_BOX", 0},
    {"DEFINE_BOX_LOCAL", 0},
    {"DEFINE_COORDINATE_NODES", bits({1, 2, 3})},
    {"DEFINE_COORDINATE_SYSTEM", 0},
    {"DEFINE_COORDINATE_VECTOR", bits({7})},
    {"DEFINE_SD_ORIENTATION", bits({5, 6})},
    {"DEFINE_TRANSFORMATION", 0},
    {"DEFINE_VECTOR", 0},
    {"DEFINE_VECTOR_NODES", bits({1, 2})},
    {"ELEMENT_BEAM", bits({2, 3, 4})},
    {"ELEMENT_DISCRETE", bits({2, 3})},
    {"ELEMENT_MASS", bits({1})},
    {"ELEMENT_PLOTEL", bits({1, 2})},
    {"ELEMENT_SHELL", kShell},
    {"ELEMENT_TSHELL", kShell},
    {"INITIAL_TEMPERATURE_NODE", bits({0})},
    {"INITIAL_VELOCITY", 0},
    {"INITIAL_VELOCITY_NODE", bits({0})},
    {"INITIAL_VELOCITY_RIGID_BODY", 0},
    {"LOAD_NODE_POINT", bits({0, 5, 6, 7})},
    {"LOAD_NODE_SET", bits({5, 6, 7})},
    {"LOAD_RIGID_BODY", bits({5, 6, 7})},
    {"LOAD_SEGMENT", bits({3, 4, 5, 6, 7}), 1, bits({0, 1, 2}), &is_segment_longer},
    {"LOAD_THERMAL_CONSTANT", 0},
    {"LOAD_THERMAL_CONSTANT_NODE", bits({0})},
    {"LOAD_THERMAL_VARIABLE", 0},
    {"LOAD_THERMAL_VARIABLE_NODE", bits({0})},
});

}  // namespace

LsDynaNodeFields::LsDynaNodeFields(std::string_view keyword) {
  // Each line of it has a heading behind the node.
  static constexpr Form kHistory = {"DATABASE_HISTORY_NODE_ID", bits({0})};
  static constexpr Form kNone = {"RIGIDWALL_", 0};
  if (keyword == kHistory.keyword) form_ = &kHistory;
  if (keyword.starts_with(kNone.keyword)) form_ = &kNone;
  if (form_ != nullptr) return;
  for (const std::string_view option : {"_ID", "_TITLE"}) {
    if (!keyword.ends_with(option)) continue;
    keyword.remove_suffix(option.size());
    is_heading_ = true;
    break;
  }
  const auto found = std::find_if(kForms.begin(), kForms.end(),
                                  [&](const Form& form) { return form.keyword == keyword; });
  if (found != kForms.end()) form_ = &*found;
}

std::uint32_t LsDynaNodeFields::of_line(std::span<const std::string_view> fields) {
  if (are_all()) return kAllFields;
  if (is_heading_) {
    is_heading_ = false;
    return 0;
  }
  if (is_longer_) {
    is_longer_ = false;
    return form_->after;
  }
  const std::uint32_t mask = line_ == 0 ? form_->first : 0;
  is_longer_ = form_->is_longer != nullptr && form_->is_longer(fields);
  line_ = (line_ + 1) % form_->lines;
  return mask;
}

}  // namespace tetmend::formats
