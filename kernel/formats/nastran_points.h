// SPDX-License-Identifier: MIT
// The points of Nastran's bulk data, and the systems of coordinates that they are given in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "kernel/formats/gmsh_tags.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/nastran_sources.h"
#include "kernel/formats/nastran_systems.h"
#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// A card at a time; its errors name the file, the line and the word.
class NastranCardReader {
 protected:
  explicit NastranCardReader(const NastranSources& sources) : sources_(sources) {}

  [[noreturn]] void fail_at(const char* place, std::string_view reason) const {
    sources_.file_of(place).fail_at_line(place, reason);
  }
  [[noreturn]] void fail(std::string_view where, std::string_view reason) const {
    fail_at(where.empty() ? card_.text.data() : where.data(), reason);
  }
  /// A field that must be an integer from `low` to `high`.
  std::int64_t integer(std::size_t i, std::string_view what, std::int64_t low,
                       std::int64_t high) const;
  /// True if it has nothing from this field on.
  bool is_blank(std::size_t first) const;
  /// All of its lines, each with a line break.
  std::string card_text() const;

  const NastranSources& sources_;
  NastranCardText card_;
};

/// A text that ends in a line break.
std::string nastran_lines(std::string_view text);
/// Comments within a card that is written anew.
void keep_nastran_comments(const NastranCardText& card, std::string& lines);

class NastranPoints : private NastranCardReader {
 public:
  NastranPoints(const NastranSources& sources, MeshData& mesh)
      : NastranCardReader(sources), mesh_(mesh) {}

  /// Into the mesh, with their numbers, where they stand in the deck: in their own systems. What they
  /// say besides goes into its deck. @throws Error
  void read();
  /// From the systems that they are given in to the basic one. @throws Error
  void place();

  /// GmshTags::kNone if no point has this number.
  std::uint32_t find(std::int64_t number) const {
    const std::uint32_t found = tags_.find(number);
    return found == GmshTags::kNone ? found : order_[found];
  }
  /// Points in which their numbers ascend.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Where in that order the numbers from `number` on begin.
  std::size_t place_from(std::int64_t number) const;

  /// Points with permanent constraints.
  struct Held {
    std::int64_t number;
    const char* place;  ///< of the card
  };
  const std::vector<Held>& held() const { return held_; }
  /// Cards that are written anew without the comments behind their fields.
  std::size_t lost_comments() const { return lost_comments_; }

 private:
  void number();
  void read_point();
  std::int64_t read_system(std::size_t field) const;
  void read_definition();
  void apply_default_system();
  void place(std::uint32_t point);

  MeshData& mesh_;
  std::vector<const char*> places_;  // of their cards
  std::vector<Held> held_;
  std::size_t lost_comments_ = 0;
  NastranSystems systems_;
  std::int64_t default_system_ = 0;
  std::unordered_map<std::uint32_t, std::int64_t> waiting_;  // not placed yet: their systems
  std::vector<std::uint32_t> order_;
  GmshTags tags_;
};

}  // namespace tetmend::formats
