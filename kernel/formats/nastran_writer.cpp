// SPDX-License-Identifier: MIT
// Writes Nastran's bulk data in free fields, and around them the rest of the deck.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/nastran_numbers.h"
#include "kernel/formats/nastran_systems.h"
#include "kernel/formats/new_numbers.h"
#include "kernel/formats/output_rows.h"

namespace tetmend::formats {
namespace {

/// What elements of one number have to tell them apart: dimension, and number of corners.
using Corners = std::pair<int, std::size_t>;

/// Cards of points or elements that are kept word for word, by number. The text must outlive it.
class WholeCards {
 public:
  WholeCards() = default;
  explicit WholeCards(const std::string& text) {
    NastranLines lines(text.data(), text.data() + text.size());
    NastranCardText card;
    while (!lines.at_end()) {
      lines.read(card);
      std::int64_t number = 0;
      if (!nastran_integer(card.field(0), number)) continue;
      cards_.push_back({number, corners_of(card.name), card.text});
    }
    std::stable_sort(cards_.begin(), cards_.end(),
                     [](const Card& a, const Card& b) { return a.number < b.number; });
  }

  /// Empty if there is none.
  std::string_view of(std::int64_t number, Corners corners = {}) const {
    auto found =
        std::lower_bound(cards_.begin(), cards_.end(), number,
                         [](const Card& card, std::int64_t of) { return card.number < of; });
    for (; found != cards_.end() && found->number == number; ++found) {
      if (found->corners == corners) return found->text;
    }
    return {};
  }

 private:
  struct Card {
    std::int64_t number;
    Corners corners;
    std::string_view text;
  };

  static Corners corners_of(std::string_view name) {
    for (const NastranCard& card : kNastranCards) {
      if (card.name == name)
        return {element_kind(card.vtk_type)->dimension, element_kind(card.vtk_type)->corners};
    }
    return {};
  }

  std::vector<Card> cards_;
};

/// The largest numbers of points and of elements in the cards that are kept.
struct Largest {
  std::int64_t point = 0;
  std::int64_t element = 0;
};

Largest largest_of_cards(const std::string& cards) {
  Largest largest;
  NastranLines lines(cards.data(), cards.data() + cards.size());
  NastranCardText card;
  while (!lines.at_end()) {
    lines.read(card);
    const bool has_points = card.name == "SPOINT" || card.name == "EPOINT";
    const bool is_element = card.name.starts_with('C') || card.name.starts_with('R');
    for (std::size_t i = 0; i < card.fields.size() && (has_points || is_element); ++i) {
      std::int64_t number = 0;
      if (!nastran_integer(card.fields[i], number)) continue;
      std::int64_t& most = has_points ? largest.point : largest.element;
      most = std::max(most, number);
      if (is_element) break;
    }
  }
  return largest;
}

class NastranWriter {
 public:
  NastranWriter(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file), mesh_(mesh), lists_(mesh) {
    const MeshData* data = mesh.data();
    for (const std::string_view form : kNastranForms) {
      if (mesh.variant() == form) form_ = form;
    }
    was_deck_ = data != nullptr && data->variant == kNastran;
    if (was_deck_ && data->deck.size() >= nastran_pieces) {
      deck_ = &data->deck;
      points_of_deck_ = WholeCards((*deck_)[nastran_points]);
      elements_of_deck_ = WholeCards((*deck_)[nastran_elements]);
      largest_ = largest_of_cards((*deck_)[nastran_cards]);
    }
  }

  void write() {
    number_points();
    number_elements();
    number_properties();
    find_systems();
    use_line_breaks();
    put_of_deck(nastran_front, "BEGIN BULK\n");
    write_points();
    for (std::size_t k = 0; k < lists_.all().size(); ++k) write_elements(k);
    put_of_deck(nastran_cards, "");
    put_of_deck(nastran_end, "ENDDATA\n");
    out_.commit(mesh_.companions());
  }

 private:
  void put_of_deck(NastranPiece piece, std::string_view otherwise) {
    out_.put_as_it_is(deck_ == nullptr ? otherwise : (*deck_)[piece]);
  }

  /// As the deck has them, by what is sure to be its own.
  void use_line_breaks() {
    if (deck_ == nullptr) return;
    for (const NastranPiece piece : {nastran_end, nastran_cards, nastran_front}) {
      if ((*deck_)[piece].find('\n') == std::string::npos) continue;
      return out_.use_line_breaks_of((*deck_)[piece]);
    }
  }

  /// Those of Nastran have at most eight digits; others are read as well.
  NewNumbers new_numbers(std::int64_t most, std::span<const std::int64_t> known,
                         std::span<const NumberRange> of_file) const {
    static constexpr std::array<std::int64_t, 3> kLimits = {99'999'999, INT32_MAX, INT64_MAX};
    return numbers_beside(known, of_file, kLimits, most, [this] {
      std::vector<NumberRange> taken;
      if (deck_ != nullptr) add_nastran_numbers((*deck_)[nastran_cards], taken);
      return taken;
    });
  }

  void number_points() {
    std::vector<std::int64_t> known;
    std::span<const NumberRange> of_file;
    if (mesh_.data() != nullptr) {
      known = points_ = mesh_.data()->point_numbers;
      of_file = mesh_.data()->taken_point_numbers;
    }
    points_.resize(mesh_.point_count(), 0);
    NewNumbers next = new_numbers(largest_.point, known, of_file);
    complete(points_, next);
  }

  /// Elements of all kinds share their numbers.
  void number_elements() {
    std::vector<std::int64_t> known;
    std::span<const NumberRange> of_file = lists_.taken_numbers();
    for (const ElementList& list : lists_.all()) {
      auto& numbers = elements_.emplace_back();
      if (list.numbers != nullptr) numbers = *list.numbers;
      numbers.resize(list.count, 0);
      std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(known),
                   [](std::int64_t number) { return number > 0; });
    }
    std::sort(known.begin(), known.end());
    // Those of a deck differ among the elements of each kind.
    const bool differ = was_deck_ || std::adjacent_find(known.begin(), known.end()) == known.end();
    if (!differ) {
      known.clear();
      of_file = {};
      for (auto& numbers : elements_) std::fill(numbers.begin(), numbers.end(), 0);
    }
    NewNumbers next = new_numbers(largest_.element, known, of_file);
    for (auto& numbers : elements_) complete(numbers, next);
  }

  /// Properties count from 1: other labels get the next numbers. In a deck 0 is a blank field.
  void number_properties() {
    std::set<Label> labels;
    for (const ElementList& list : lists_.all()) {
      if (list.kind.dimension < 2) continue;
      Label last = 1;
      for (std::size_t i = 0; i < list.count; ++i) {
        if (list.label(i) != last) labels.insert(last = list.label(i));
      }
    }
    Label next = 0;
    for (const Label label : labels) {
      if (label > 0) break;
      if (label == 0 && was_deck_) continue;
      while (labels.contains(++next)) {
      }
      properties_[label] = next;
    }
  }

  /// Of the cards that are kept: where points that move are written in another system.
  void find_systems() {
    if (deck_ == nullptr) return;
    NastranSystems systems;
    std::set<std::int64_t> used;
    NastranCardText card;
    for (const NastranPiece piece : {nastran_cards, nastran_points}) {
      const std::string& text = (*deck_)[piece];
      NastranLines lines(text.data(), text.data() + text.size());
      while (!lines.at_end()) {
        lines.read(card);
        systems.add(card);
        std::int64_t number = 0;
        if ((card.name == "GRID" || card.name == "GRDSET") &&
            nastran_integer(card.field(1), number)) {
          used.insert(number);
          if (card.name == "GRDSET") default_system_ = number;
        }
      }
    }
    if (systems.is_empty()) return;
    std::map<std::int64_t, Point> points;
    const auto point_of = [&](std::int64_t number) -> const Point* {
      if (points.empty()) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
          points.emplace(points_[i], mesh_.point(i));
        }
      }
      const auto found = points.find(number);
      return found == points.end() ? nullptr : &found->second;
    };
    try {
      for (const std::int64_t number : used) systems_[number] = systems.find(number, point_of);
    } catch (const NastranSystems::Failure& failure) {
      throw Error(failure.reason);
    }
  }

  void write_points() {
    put_rows(out_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
      const std::string_view known = points_of_deck_.of(points_[i]);
      NastranCardText card;
      if (!known.empty()) NastranLines(known.data(), known.data() + known.size()).read(card);
      const NastranSystem* system = known.empty() ? nullptr : system_of(card);
      if (!known.empty() && stands_at(card, system, mesh_.point(i))) return put_known(buffer, card);
      const Point& point = mesh_.point(i);
      put_point(buffer, i, card, system == nullptr ? point : system->from_basic(point));
    });
  }

  /// A card of the deck: word for word, if it may stand in any form.
  void put_known(OutputBuffer& buffer, const NastranCardText& card) const {
    if (form_.empty()) return buffer.put(card.text);
    for (const std::string_view comment : card.comments) buffer.put(comment);
    std::vector<std::string> fields(card.fields.begin(), card.fields.end());
    while (!fields.empty() && fields.back().empty()) fields.pop_back();
    const bool is_point = card.name == "GRID";
    for (std::size_t k = 2; is_point && form_ == kNastranRounded && k < 5; ++k) {
      double value = 0;
      if (k >= fields.size() || fields[k].size() <= kNastranRoom) continue;
      if (nastran_real(fields[k], value)) fields[k] = in_room(value);
    }
    put_nastran_card(buffer, card.name, fields, is_point ? form_ : element_form());
  }

  static std::string in_room(double value) {
    std::string text = nastran_real_field(value, kNastranRoom);
    return text.empty() ? nastran_rounded(value) : text;
  }

  /// In which a point of the deck is given; null: the basic one.
  const NastranSystem* system_of(const NastranCardText& card) const {
    std::int64_t number = 0;
    if (!nastran_integer(card.field(1), number)) number = default_system_;
    const auto found = systems_.find(number);
    return number == 0 || found == systems_.end() ? nullptr : &found->second;
  }

  /// @param card the old one of a point that moved; else it has no fields
  void put_point(OutputBuffer& buffer, std::size_t i, const NastranCardText& card,
                 const Point& coordinates) const {
    std::array<char, 24> number{};
    const auto [end, error] =
        std::to_chars(number.data(), number.data() + number.size(), points_[i]);
    std::array<std::string, 3> reals;
    std::array<std::string_view, 8> fields = {
        std::string_view(number.data(), static_cast<std::size_t>(end - number.data())),
        card.field(1)};
    if (card.fields.empty() && default_system_ != 0) fields[1] = "0";
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = coordinates[static_cast<Eigen::Index>(k)];
      const bool may_round = was_deck_ || form_ == kNastranRounded;
      reals[k] = may_round ? in_room(value) : nastran_real_field(value, kNastranRoom);
      if (reals[k].empty()) reals[k] = nastran_digits(value);
      fields[2 + k] = reals[k];
    }
    for (std::size_t k = 5; k < 8; ++k) fields[k] = card.field(k);
    std::size_t count = fields.size();
    while (count > 5 && fields[count - 1].empty()) --count;
    if (!form_.empty()) return put_point_as(buffer, {fields.data(), count}, coordinates);
    const bool is_fixed = std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
      return field.size() <= kNastranRoom;
    });
    constexpr std::string_view kBlanks = "                ";
    buffer.put(std::string_view(is_fixed ? "GRID*   " : "GRID*"));
    for (std::size_t k = 0; k < count; ++k) {
      if (k == 4) buffer.put(std::string_view(is_fixed ? "\n*       " : "\n*"));
      if (is_fixed) {
        buffer.put(kBlanks.substr(0, kNastranRoom - fields[k].size()));
      } else {
        buffer.put(',');
      }
      buffer.put(fields[k]);
    }
    buffer.put('\n');
  }

  /// In the form that was asked for, with digits that have room in it.
  void put_point_as(OutputBuffer& buffer, std::span<const std::string_view> fields,
                    const Point& coordinates) const {
    std::vector<std::string> all(fields.begin(), fields.end());
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = coordinates[static_cast<Eigen::Index>(k)];
      std::string text =
          form_ == kNastranShort ? nastran_real_field(value, kNastranShortRoom) : std::string();
      if (form_ == kNastranFree) text = nastran_digits(value);
      if (!text.empty()) all[2 + k] = std::move(text);
    }
    put_nastran_card(buffer, "GRID", all, form_);
  }

  /// True if the card says just this place.
  static bool stands_at(const NastranCardText& card, const NastranSystem* system,
                        const Point& point) {
    Point place = Point::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = card.field(2 + static_cast<std::size_t>(axis));
      if (!field.empty() && !nastran_real(field, place[axis])) return false;
    }
    return (system == nullptr ? place : system->to_basic(place)) == point;
  }

  void write_elements(std::size_t k) {
    const ElementList& list = lists_.all()[k];
    const auto* card =
        std::find_if(kNastranCards.begin(), kNastranCards.end(),
                     [&](const NastranCard& each) { return each.vtk_type == list.kind.vtk_type; });
    if (card == kNastranCards.end()) return;
    put_rows(out_, list.count, [&](std::size_t i, OutputBuffer& buffer) {
      const std::int64_t number = elements_[k][i];
      const std::string_view whole =
          elements_of_deck_.of(number, {list.kind.dimension, list.kind.corners});
      if (!whole.empty()) {
        NastranCardText known;
        NastranLines(whole.data(), whole.data() + whole.size()).read(known);
        return put_known(buffer, known);
      }
      if (!form_.empty()) return put_element_as(buffer, card->name, k, i);
      buffer.put(card->name);
      buffer.put(',');
      buffer.put_integer(number);
      buffer.put(',');
      const Label label = list.label(i);
      if (label > 0) {
        buffer.put_integer(label);
      } else {
        buffer.put(property(label));
      }
      put_nodes(buffer, list, i);
      buffer.put('\n');
    });
  }

  /// Of a deck elements without one keep what they had in that field.
  std::string property(Label label) const {
    if (label != 0 || !was_deck_) return fmt::to_string(label > 0 ? label : properties_.at(label));
    return deck_ == nullptr ? std::string() : (*deck_)[nastran_zero];
  }

  void put_element_as(OutputBuffer& buffer, std::string_view name, std::size_t k,
                      std::size_t i) const {
    const ElementList& list = lists_.all()[k];
    const Label label = list.label(i);
    std::vector<std::string> fields = {fmt::to_string(elements_[k][i]), property(label)};
    const auto listed = listed_nodes(list, i);
    for (std::size_t n = 0; n < list.kind.width; ++n)
      fields.push_back(fmt::to_string(points_[listed[n]]));
    put_nastran_card(buffer, name, fields, element_form());
  }

  /// Whole numbers have room in short fields, and some programs read elements in these alone.
  std::string_view element_form() const { return form_ == kNastranFree ? form_ : kNastranShort; }

  static std::array<std::uint32_t, kMostVerticesOfElement> listed_nodes(const ElementList& list,
                                                                        std::size_t i) {
    const auto v = list.vertices(i);
    const std::uint8_t* order = nastran_order(list.kind.vtk_type);
    std::array<std::uint32_t, kMostVerticesOfElement> listed{};
    for (std::size_t k = 0; k < v.size(); ++k) listed[order == nullptr ? k : order[k]] = v[k];
    return listed;
  }

  void put_nodes(OutputBuffer& buffer, const ElementList& list, std::size_t i) const {
    const auto v = list.vertices(i);
    const auto listed = listed_nodes(list, i);
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (k == 6 || k == 14) buffer.put(",+\n+");  // eight fields a line, the first two are taken
      buffer.put(',');
      buffer.put_integer(points_[listed[k]]);
    }
  }

  OutputFile out_;
  const MeshView& mesh_;
  ElementLists lists_;
  const std::vector<std::string>* deck_ = nullptr;  // null: not ours
  bool was_deck_ = false;                           // the mesh came from one
  std::string_view form_;                           // that was asked for; empty: as it likes
  WholeCards points_of_deck_, elements_of_deck_;
  std::map<std::int64_t, NastranSystem> systems_;
  std::int64_t default_system_ = 0;  // of GRDSET
  Largest largest_;
  std::vector<std::int64_t> points_;                 // their numbers
  std::vector<std::vector<std::int64_t>> elements_;  // of each list
  std::map<Label, Label> properties_;                // for labels below 1
};

}  // namespace

void write_nastran(const std::filesystem::path& file, const MeshView& mesh) {
  NastranWriter(file, mesh).write();
}

}  // namespace tetmend::formats
