// SPDX-License-Identifier: MIT
// Writes Nastran's bulk data in free fields, and around them the rest of the deck.
#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_rows.h"
#include "kernel/formats/nastran.h"
#include "kernel/formats/nastran_card.h"
#include "kernel/formats/new_numbers.h"
#include "kernel/formats/output_rows.h"

namespace tetmend::formats {
namespace {

/// Reals have a point.
void put_nastran_real(OutputBuffer& buffer, double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  const std::string_view digits(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t exponent = std::min(digits.find('e'), digits.size());
  buffer.put(digits.substr(0, exponent));
  if (digits.find('.') == std::string_view::npos) buffer.put('.');
  buffer.put(digits.substr(exponent));
}

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
      if (nastran_integer(card.field(0), number)) cards_.emplace_back(number, card.text);
    }
    std::stable_sort(cards_.begin(), cards_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  /// Empty if there is none.
  std::string_view of(std::int64_t number) const {
    const auto found =
        std::lower_bound(cards_.begin(), cards_.end(), number,
                         [](const auto& card, std::int64_t of) { return card.first < of; });
    return found == cards_.end() || found->first != number ? std::string_view() : found->second;
  }

 private:
  std::vector<std::pair<std::int64_t, std::string_view>> cards_;
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

class Writer {
 public:
  Writer(const std::filesystem::path& file, const MeshView& mesh)
      : out_(file), mesh_(mesh), lists_(mesh) {
    const MeshData* data = mesh.data();
    if (data != nullptr && data->variant == kNastran && data->deck.size() >= nastran_pieces) {
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
    out_.put(deck_ == nullptr ? "BEGIN BULK\n" : (*deck_)[nastran_front]);
    write_points();
    for (std::size_t k = 0; k < lists_.all().size(); ++k) write_elements(k);
    if (deck_ != nullptr) out_.put((*deck_)[nastran_cards]);
    out_.put(deck_ == nullptr ? "ENDDATA\n" : (*deck_)[nastran_end]);
    out_.commit(mesh_.companions());
  }

 private:
  /// Those of Nastran have at most eight digits; others are read as well.
  NewNumbers new_numbers(std::int64_t most, const std::vector<std::int64_t>& known) const {
    constexpr std::array<std::int64_t, 3> kLimits = {99'999'999, INT32_MAX, INT64_MAX};
    return NewNumbers(most, kLimits, [this, &known] {
      std::vector<NewNumbers::Range> taken;
      for (const std::int64_t number : known) taken.emplace_back(number, number);
      if (deck_ != nullptr) add_nastran_numbers((*deck_)[nastran_cards], taken);
      return taken;
    });
  }

  void number_points() {
    std::int64_t most = largest_.point;
    std::vector<std::int64_t> known;
    if (mesh_.data() != nullptr) known = points_ = mesh_.data()->point_numbers;
    for (const std::int64_t number : points_) most = std::max(most, number);
    points_.resize(mesh_.point_count(), 0);
    NewNumbers numbers = new_numbers(most, known);
    for (std::int64_t& number : points_) {
      if (number <= 0) number = numbers.next();
    }
  }

  /// Elements of all kinds share their numbers.
  void number_elements() {
    std::int64_t most = largest_.element;
    std::vector<std::int64_t> known;
    for (const ElementList& list : lists_.all()) {
      auto& numbers = elements_.emplace_back();
      if (list.numbers != nullptr) numbers = *list.numbers;
      for (const std::int64_t number : numbers) {
        if (number > 0) known.push_back(number);
      }
    }
    std::sort(known.begin(), known.end());
    const bool differ = std::adjacent_find(known.begin(), known.end()) == known.end();
    if (differ && !known.empty()) most = std::max(most, known.back());
    if (!differ) known.clear();
    NewNumbers new_ones = new_numbers(most, known);
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      elements_[k].resize(lists_.all()[k].count, 0);
      for (std::int64_t& number : elements_[k]) {
        if (number <= 0 || !differ) number = new_ones.next();
      }
    }
  }

  /// Properties count from 1: other labels get the next numbers.
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
      while (labels.contains(++next)) {
      }
      properties_[label] = next;
    }
  }

  void write_points() {
    put_rows(out_, mesh_.point_count(), [this](std::size_t i, OutputBuffer& buffer) {
      const std::string_view known = points_of_deck_.of(points_[i]);
      NastranCardText card;
      if (!known.empty()) NastranLines(known.data(), known.data() + known.size()).read(card);
      if (!known.empty() && stands_at(card, mesh_.point(i))) return buffer.put(known);
      buffer.put("GRID*,");
      buffer.put_integer(points_[i]);
      buffer.put(",,");
      put_nastran_real(buffer, mesh_.point(i)[0]);
      buffer.put(',');
      put_nastran_real(buffer, mesh_.point(i)[1]);
      buffer.put("\n*,");
      put_nastran_real(buffer, mesh_.point(i)[2]);
      // What else the card of a point that moved says: fields 7 to 9.
      for (std::size_t k = 5; k < 8 && !known.empty(); ++k) {
        buffer.put(',');
        buffer.put(card.field(k));
      }
      buffer.put('\n');
    });
  }

  /// True if the card says just this place.
  static bool stands_at(const NastranCardText& card, const Point& point) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view field = card.field(2 + static_cast<std::size_t>(axis));
      double value = 0;
      if (!field.empty() && !nastran_real(field, value)) return false;
      if (value != point[axis]) return false;
    }
    return true;
  }

  void write_elements(std::size_t k) {
    const ElementList& list = lists_.all()[k];
    const auto* card =
        std::find_if(kNastranCards.begin(), kNastranCards.end(),
                     [&](const NastranCard& each) { return each.vtk_type == list.kind.vtk_type; });
    if (card == kNastranCards.end()) return;
    put_rows(out_, list.count, [&](std::size_t i, OutputBuffer& buffer) {
      const std::int64_t number = elements_[k][i];
      const std::string_view whole = elements_of_deck_.of(number);
      if (!whole.empty()) return buffer.put(whole);
      buffer.put(card->name);
      buffer.put(',');
      buffer.put_integer(number);
      buffer.put(',');
      const Label label = list.label(i);
      buffer.put_integer(label > 0 ? label : properties_.at(label));
      put_nodes(buffer, list, i);
      buffer.put('\n');
    });
  }

  void put_nodes(OutputBuffer& buffer, const ElementList& list, std::size_t i) const {
    const auto v = list.vertices(i);
    const std::uint8_t* order = nastran_order(list.kind.vtk_type);
    std::array<std::uint32_t, kMostVerticesOfElement> listed{};
    for (std::size_t k = 0; k < v.size(); ++k) listed[order == nullptr ? k : order[k]] = v[k];
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
  WholeCards points_of_deck_, elements_of_deck_;
  Largest largest_;
  std::vector<std::int64_t> points_;                 // their numbers
  std::vector<std::vector<std::int64_t>> elements_;  // of each list
  std::map<Label, Label> properties_;                // for labels below 1
};

}  // namespace

void write_nastran(const std::filesystem::path& file, const MeshView& mesh) {
  Writer(file, mesh).write();
}

}  // namespace tetmend::formats
