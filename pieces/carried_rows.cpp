// SPDX-License-Identifier: MIT
#include "pieces/carried_rows.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "face/carry.h"
#include "pieces/bytes.h"
#include "pieces/new_part.h"
#include "pieces/old_part.h"
#include "pieces/post.h"

namespace tetmend::pieces {

namespace {

std::string rows_name(RowKind kind, std::size_t part) {
  return fmt::format("rows-{}-{}", static_cast<int>(kind), part);
}

/// Who has a piece.
std::vector<std::uint32_t> owners_of(const DividedMesh& mesh) {
  std::string mine;
  put(std::vector<std::uint64_t>(mesh.own().begin(), mesh.own().end()), mine);
  std::vector<std::uint32_t> owners(mesh.state().stored, 0);
  std::uint32_t rank = 0;
  for (const std::string& from : mesh.ranks().gather(mine)) {
    std::string_view rest = from;
    std::vector<std::uint64_t> own;
    take(rest, own);
    for (const std::uint64_t part : own) owners[part] = rank;
    ++rank;
  }
  return owners;
}

/// One call of CarriedRows().
class RowCarrier {
 public:
  RowCarrier(const RowSource& source, const DividedMesh& mesh, std::size_t tets_of_slice,
             std::size_t parts, Shelf& shelf, std::span<const std::string> conserve)
      : source_(source),
        mesh_(mesh),
        ranks_(mesh.ranks()),
        shelf_(shelf),
        layouts_(source.row_layouts()),
        parting_(mesh.cut(parts, 0)),
        margin_(kMargin * parting_.side),
        tets_of_slice_(tets_of_slice),
        slices_(source.slice_count(tets_of_slice, ranks_)),
        old_(shelf, ranks_, pieces::owners_of(parting_, ranks_.count()), "old"),
        questions_(shelf, ranks_, pieces::owners_of(parting_, ranks_.count()), "questions"),
        names_(shelf, ranks_, owners_of_slices(slices_, ranks_.count()), "names"),
        answers_(shelf, ranks_, owners_of(mesh), "answers") {
    const std::vector<DataArray>& arrays = layouts_[RowKind::tet].arrays();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (std::find(conserve.begin(), conserve.end(), arrays[i].name) != conserve.end()) {
        conserved_.push_back(i);
      }
    }
  }

  void run() {
    send_old();
    ask();
    answer_for_parts();
    answer_for_vertices();
    receive();
  }
  std::vector<CarriedArray> report();

 private:
  /// By rounding a place may lie outside of the tets: so little, by the side of the mesh.
  static constexpr double kMargin = 1e-9;

  /// Each has a range.
  static std::vector<std::uint32_t> owners_of_slices(std::uint64_t slices, std::uint64_t ranks) {
    std::vector<std::uint32_t> owners;
    for (std::uint64_t rank = 0; rank < ranks; ++rank) {
      const std::uint64_t size = FileRange::of_slice(slices, rank, ranks).size();
      owners.insert(owners.end(), size, static_cast<std::uint32_t>(rank));
    }
    return owners;
  }
  bool has(RowKind kind) const { return layouts_[kind].size() > 0; }
  /// Places are looked up in old tets.
  bool needs_tets() const { return has(RowKind::point) || has(RowKind::tet); }
  /// Rows of something besides vertices.
  bool needs_parts() const { return needs_tets() || has(RowKind::triangle) || has(RowKind::edge); }
  static std::string name_of_slice(std::uint64_t number) {
    return fmt::format("vertices-{}", number);
  }

  void send_old();
  void send_slice(std::uint64_t number, const RowSlice& slice);
  void keep_vertices(std::uint64_t number, const RowSlice& slice);
  void ask();
  void answer_for_parts();
  void answer_for_vertices();
  void receive();

  const RowSource& source_;
  const DividedMesh& mesh_;
  Ranks& ranks_;
  Shelf& shelf_;
  const ByKind<RowLayout> layouts_;
  const Parting parting_;
  const double margin_;
  const std::size_t tets_of_slice_;
  const std::uint64_t slices_;
  std::vector<std::size_t> conserved_;
  Post old_, questions_;                                         // by part of space
  Post names_;                                                   // by slice
  Post answers_;                                                 // by stored piece
  std::map<std::uint64_t, std::vector<double>> before_, after_;  // integrals by part
};

void RowCarrier::send_old() {
  // A slice at a time on each rank, as far as it has one.
  const std::uint64_t most = (slices_ + ranks_.count() - 1) / ranks_.count();
  std::uint64_t sent = 0;
  source_.for_row_slices(tets_of_slice_, ranks_, [&](std::uint64_t number, const RowSlice& slice) {
    if (needs_parts()) send_slice(number, slice);
    if (has(RowKind::vertex)) keep_vertices(number, slice);
    old_.deliver();
    ++sent;
  });
  for (; sent < most; ++sent) old_.deliver();
}

void RowCarrier::keep_vertices(std::uint64_t number, const RowSlice& slice) {
  const std::size_t size = layouts_[RowKind::vertex].size();
  std::string rows;
  for (std::size_t v = 0; v < slice.piece.ids.size(); ++v) {
    if (is_own(slice.piece.marks[v])) rows.append(slice.rows[RowKind::vertex], v * size, size);
  }
  shelf_.put(name_of_slice(number), std::move(rows));
}

/// A tet goes to all parts that its box meets, all else to one.
void RowCarrier::send_slice(std::uint64_t number, const RowSlice& slice) {
  const Piece& piece = slice.piece;
  const std::vector<std::uint32_t> parts = parting_.parts_of(std::span(piece.points));
  std::vector<Extract> shares(parting_.stretches());
  const auto wanted = [&](std::uint32_t part) -> std::vector<char>& {
    std::vector<char>& marks = shares[part].wanted;
    if (marks.empty()) marks.assign(piece.ids.size(), 0);
    return marks;
  };
  const auto add = [&](std::uint32_t part, std::uint32_t i, const auto& element, auto list) {
    std::vector<char>& vertices = wanted(part);
    for (const std::uint32_t v : element.vertices) vertices[v] = 1;
    (shares[part].*list).push_back(i);
  };
  const auto home = [&](const auto& element) {
    return parts[*std::min_element(element.vertices.begin(), element.vertices.end())];
  };
  for (std::size_t v = 0; v < piece.ids.size(); ++v) {
    if (is_own(piece.marks[v])) wanted(parts[v])[v] = 1;
  }
  for (std::uint32_t t = 0; needs_tets() && t < piece.tets.size(); ++t) {
    const PieceTet& tet = piece.tets[t];
    const std::array<Point, 4> corners = corners_of(piece.points, tet.vertices);
    for (const std::uint32_t part : parting_.stretches_of(box_of(corners, margin_))) {
      add(part, t, tet, &Extract::tets);
    }
  }
  for (std::uint32_t i = 0; i < piece.triangles.size(); ++i) {
    add(home(piece.triangles[i]), i, piece.triangles[i], &Extract::triangles);
  }
  for (std::uint32_t i = 0; i < piece.edges.size(); ++i) {
    add(home(piece.edges[i]), i, piece.edges[i], &Extract::edges);
  }
  for (std::uint32_t part = 0; part < shares.size(); ++part) {
    if (!shares[part].wanted.empty()) {
      old_.send(number, part, to_message(slice, shares[part], layouts_));
    }
  }
}

void RowCarrier::ask() {
  std::size_t next = 0;
  const auto ask_one = [&](std::size_t part) {
    const NewPart piece(mesh_, part, layouts_);
    if (needs_parts()) {
      const std::vector<Questions> all = piece.ask(parting_, margin_, !conserved_.empty());
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].is_empty()) questions_.send(part, i, all[i].bytes());
      }
    }
    if (!has(RowKind::vertex)) return;
    const auto names = piece.ask_for_vertices(slices_);
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string bytes;
      put(names[i], bytes);
      if (!names[i].empty()) names_.send(part, i, bytes);
    }
  };
  do {
    if (next < mesh_.own().size()) ask_one(mesh_.own()[next++]);
    questions_.deliver();
    names_.deliver();
  } while (ranks_.any(next < mesh_.own().size()));
}

void RowCarrier::answer_for_parts() {
  if (!needs_parts()) return;
  answers_.send_by_address(questions_, [&](std::size_t part) {
    const auto number = static_cast<std::uint32_t>(part);
    OldPart old(old_.take(part), layouts_, parting_, number);
    before_[part] = old.integrals();
    const auto messages = questions_.take(part);
    for (const auto& message : messages) {
      for (const std::uint64_t tet : Questions(message.second).kept) old.keep(tet);
    }
    if (needs_tets()) {
      old.find_changed();
      for (const auto& message : messages) old.learn(Questions(message.second));
    }
    for (const auto& message : messages) {
      Answers answers;
      old.answer(Questions(message.second), answers);
      if (!answers.is_empty()) answers_.send(part, message.first, answers.bytes());
    }
  });
}

void RowCarrier::answer_for_vertices() {
  if (!has(RowKind::vertex)) return;
  const std::size_t size = layouts_[RowKind::vertex].size();
  const std::uint64_t vertices = mesh_.state().in_file;
  answers_.send_by_address(names_, [&](std::size_t slice) {
    const std::uint64_t first = FileRange::of_slice(vertices, slice, slices_).begin;
    const std::string rows = shelf_.read(name_of_slice(slice));
    shelf_.remove(name_of_slice(slice));
    for (const auto& [part, message] : names_.take(slice)) {
      std::string_view rest = message;
      std::vector<Questions::OfNumber> asked;
      take(rest, asked);
      Answers answers;
      for (const Questions::OfNumber& each : asked) {
        if ((each.number - first + 1) * size > rows.size()) fail_to_fit();
        answers.places[RowKind::vertex].push_back(each.place);
        answers.rows[RowKind::vertex].append(rows, (each.number - first) * size, size);
      }
      answers_.send(questions_.addresses() + slice, part, answers.bytes());
    }
  });
}

void RowCarrier::receive() {
  for (const std::size_t part : mesh_.own()) {
    NewPart made(mesh_, part, layouts_);
    made.make_room(source_.row_of_new_vertex());
    for (const auto& message : answers_.take(part)) made.take(Answers(message.second));
    made.check();
    made.average(conserved_);
    after_[part] = made.integrals();
    for (const RowKind kind : kAllRowKinds) shelf_.put(rows_name(kind, part), made.rows(kind));
  }
}

std::vector<CarriedArray> RowCarrier::report() {
  const std::size_t count = Integrals(layouts_).sums().size();
  const std::vector<double> before = Integrals::add_up(before_, count, ranks_);
  const std::vector<double> after = Integrals::add_up(after_, count, ranks_);
  std::vector<CarriedArray> report;
  std::size_t at = 0;
  for (const RowKind kind : {RowKind::point, RowKind::tet}) {
    const std::vector<DataArray>& arrays = layouts_[kind].arrays();
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      const bool is_conserved =
          kind == RowKind::tet &&
          std::find(conserved_.begin(), conserved_.end(), i) != conserved_.end();
      std::vector<face::ComponentIntegral> integrals;
      for (std::size_t k = 0; k < arrays[i].components; ++k, at += 2) {
        integrals.push_back({before[at], before[at + 1], after[at]});
      }
      report.push_back(
          face::carried_array(arrays[i], kind == RowKind::point, is_conserved, integrals));
    }
  }
  return report;
}

}  // namespace

CarriedRows::CarriedRows(const RowSource& source, const DividedMesh& mesh,
                         std::size_t tets_of_slice, std::size_t parts,
                         std::span<const std::string> conserve, Shelf& shelf)
    : layouts_(source.row_layouts()), shelf_(shelf) {
  RowCarrier carrier(source, mesh, tets_of_slice, parts, shelf, conserve);
  carrier.run();
  report_ = carrier.report();
}

std::string CarriedRows::column(RowKind kind, std::size_t part, std::size_t array,
                                std::size_t begin, std::size_t end) const {
  const RowLayout& layout = layouts_[kind];
  const std::string rows =
      shelf_.read(rows_name(kind, part), begin * layout.size(), (end - begin) * layout.size());
  std::string bytes;
  bytes.reserve((end - begin) * layout.width(array));
  layout.append_column(array, rows, bytes);
  return bytes;
}

}  // namespace tetmend::pieces
