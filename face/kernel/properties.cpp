// SPDX-License-Identifier: MIT
// Properties in step with edits and their undo.
#include "face/kernel/properties.h"

#include <algorithm>

#include <fmt/format.h>

namespace tetmend::kernel {

namespace {

std::size_t common_vertices(const TetVertices& a, const TetVertices& b) {
  return static_cast<std::size_t>(std::count_if(a.begin(), a.end(), [&b](VertexHandle v) {
    return std::find(b.begin(), b.end(), v) != b.end();
  }));
}

/// The number of the old tet that a new one is most like.
std::uint32_t nearest_old(std::span<const Journal::RemovedTet> old, const TetVertices& made) {
  std::uint32_t best = 0;
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < old.size(); ++i) {
    const std::size_t count = common_vertices(old[i].vertices, made);
    if (count <= most) continue;
    most = count;
    best = i;
  }
  return best;
}

}  // namespace

void PropertyArray::refuse(const DataArray& from, std::size_t components) const {
  throw Error(fmt::format("array '{}' has {} numbers each, and the property {}", from.name,
                          from.components, components));
}

void PropertyArray::refuse(std::uint32_t number, double value) const {
  throw Error(fmt::format("array '{}': {} at {} is no value of the type of the property", name_,
                          value, number));
}

PropertyTable::PropertyTable(const PropertyTable& other) {
  for (const auto& array : other.arrays_) arrays_.push_back(array->clone());
}

PropertyArray* PropertyTable::find(std::string_view name) const {
  const auto found = std::find_if(arrays_.begin(), arrays_.end(),
                                  [name](const auto& array) { return array->name() == name; });
  return found == arrays_.end() ? nullptr : found->get();
}

bool PropertyTable::remove(std::string_view name) {
  return std::erase_if(arrays_, [name](const auto& array) { return array->name() == name; }) > 0;
}

void PropertyKeeper::rethrow() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void PropertyKeeper::forget() noexcept {
  steps_.clear();
  slots_.clear();
  for (const PropertyTable* table : {&tets, &vertices}) {
    for (const auto& array : table->all()) array->forget();
  }
}

void PropertyKeeper::edit_made(const tetmend::TetMesh& mesh, const Journal& journal) noexcept {
  if (next_ != nullptr) next_->edit_made(mesh, journal);
  note_lock(journal.edits.back());
  if (failure_) {
    ++missed_;
    return;
  }
  try {
    follow(mesh, journal);
  } catch (...) {
    failure_ = std::current_exception();
    missed_ = 1;
  }
}

void PropertyKeeper::note_lock(const Edit& edit) {
  using Kind = Edit::Kind;
  if (locks_ == nullptr || (edit.kind != Kind::move_vertex && edit.kind != Kind::remove_vertex)) {
    return;
  }
  const std::uint32_t v = edit.vertex.index();
  if (v < locks_->values.size() && locks_->values[v]) touched_lock_ = true;
}

void PropertyKeeper::follow(const tetmend::TetMesh& mesh, const Journal& journal) {
  const Edit& edit = journal.edits.back();
  steps_.push_back({nullptr, slots_.size()});  // gone again if anything fails
  try {
    if (edit.kind == Edit::Kind::add_vertex && !vertices.empty()) {
      slots_.push_back(edit.vertex.index());
      write(vertices, {{}, std::span(slots_).last(1), {}}, mesh.vertex_slots());
    }
    if (edit.kind == Edit::Kind::replace_cavity && !tets.empty()) {
      const std::span<const Journal::RemovedTet> old(journal.removed.data() + edit.removed_begin,
                                                     edit.removed_end - edit.removed_begin);
      const bool inherits = std::any_of(tets.all().begin(), tets.all().end(),
                                        [](const auto& array) { return array->inherits(); });
      inherited_.clear();
      for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
        const TetHandle made = journal.created[k];
        slots_.push_back(made.index());
        if (inherits) inherited_.push_back(nearest_old(old, mesh.vertices(made)));
      }
      const std::size_t count = edit.created_end - edit.created_begin;
      write(tets, {old, std::span(slots_).last(count), inherited_}, mesh.tet_slots());
    }
  } catch (...) {
    slots_.resize(steps_.back().first_slot);
    steps_.pop_back();
    throw;
  }
}

/// All arrays, or none if one throws.
void PropertyKeeper::write(const PropertyTable& table, const Replaced& replaced,
                           std::size_t slots) {
  for (const auto& array : table.all()) array->grow(slots);
  for (const auto& array : table.all()) array->prepare(replaced);
  for (const auto& array : table.all()) array->write(replaced.made);
  steps_.back().table = &table;
}

void PropertyKeeper::edit_undone() noexcept {
  if (next_ != nullptr) next_->edit_undone();
  if (missed_ > 0) {
    --missed_;
    return;
  }
  const Step step = steps_.back();
  steps_.pop_back();
  if (step.table != nullptr) {
    const auto made = std::span<const std::uint32_t>(slots_).subspan(step.first_slot);
    for (const auto& array : step.table->all()) array->take_back(made);
  }
  slots_.resize(step.first_slot);
}

}  // namespace tetmend::kernel
