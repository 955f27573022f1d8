// SPDX-License-Identifier: MIT
#include "pieces/file_walk.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace tetmend::pieces {

/// Ranges of ids, of which the vertices are written at once: short enough for the memory of the first
/// rank. Each vertex is read once.
class FileWalk::Ranges {
 public:
  explicit Ranges(const DividedMesh& mesh) {
    constexpr VertexId kLeast = 50'000;
    constexpr VertexId kMost = 500'000;
    const VertexId first = mesh.state().first_id;
    const VertexId all = mesh.state().next_id - first;
    const VertexId at_once = std::clamp<VertexId>(all / (4 * mesh.ranks().count()), kLeast, kMost);
    count_ = static_cast<std::size_t>((all + at_once - 1) / at_once);
    for (const std::size_t part : mesh.own()) {
      const std::vector<VertexId> ids = mesh.stored_ids(part);
      for (std::size_t i = 0; i <= count_; ++i) {
        const auto place = std::lower_bound(ids.begin(), ids.end(), first + i * at_once);
        begins_.push_back(static_cast<std::size_t>(place - ids.begin()));
      }
    }
  }
  std::size_t count() const { return count_; }
  /// Of the vertices of own piece i those of a range: from where to where they are.
  std::pair<std::size_t, std::size_t> of_piece(std::size_t i, std::size_t range) const {
    const std::size_t at = i * (count_ + 1) + range;
    return {begins_[at], begins_[at + 1]};
  }

 private:
  std::size_t count_ = 0;
  std::vector<std::size_t> begins_;  // by own piece and range, and the end of the last one
};

FileWalk::FileWalk(const DividedMesh& mesh) : mesh_(mesh), ranks_(mesh.ranks()), numbering_(mesh) {
  count();
}

void FileWalk::count() {
  std::vector<VertexId> required;
  std::array<std::int64_t, 5> counts{};
  const auto see = [&](std::size_t kind, const auto& elements) {
    counts[kind] += static_cast<std::int64_t>(elements.size());
    for (const auto& element : elements) counts[3] += element.label != 0 ? 1 : 0;
  };
  for (const std::size_t i : mesh_.own()) {
    const Piece piece = mesh_.stored(i);
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      if ((piece.marks[v] & kOwn) == 0) continue;
      if ((piece.marks[v] & kRequired) != 0) required.push_back(piece.ids[v]);
      counts[4] += piece.label(v) != 0 ? 1 : 0;
    }
    see(0, piece.tets);
    see(1, piece.triangles);
    see(2, piece.edges);
  }
  ranks_.add(counts);
  counts_.vertices = numbering_.size();
  counts_.tets = static_cast<std::uint64_t>(counts[0]);
  counts_.triangles = static_cast<std::uint64_t>(counts[1]);
  counts_.edges = static_cast<std::uint64_t>(counts[2]);
  has_labels_ = counts[3] > 0;
  has_point_labels_ = counts[4] > 0;
  std::string bytes;
  put(required, bytes);
  for (const std::string& from : ranks_.gather(bytes)) {
    std::string_view rest = from;
    take(rest, required);
    required_.insert(required_.end(), required.begin(), required.end());
  }
  std::sort(required_.begin(), required_.end());
}

bool FileWalk::has(std::size_t part) const {
  return std::binary_search(mesh_.own().begin(), mesh_.own().end(), part);
}

/// What the ranks have for the file now, in their order.
std::vector<std::string> FileWalk::send_to_first(std::string bytes) const {
  std::vector<std::string> to(ranks_.count());
  to[0] = std::move(bytes);
  std::vector<std::string> came = ranks_.exchange(std::move(to));
  if (!ranks_.is_first()) came.clear();
  return came;
}

void FileWalk::pieces(const std::function<void(std::size_t part, std::string& bytes)>& pack,
                      const std::function<void(std::string_view)>& take_some) const {
  for (std::size_t i = 0; i < mesh_.state().stored; ++i) {
    std::string bytes;
    if (has(i)) pack(i, bytes);
    for (const std::string& from : send_to_first(std::move(bytes))) take_some(from);
  }
}

namespace {

/// Where the bytes of a vertex stand.
struct PlacedBytes {
  VertexId id;
  const char* at;
};

}  // namespace

/// A range of ids at a time, from all pieces.
void FileWalk::vertex_bytes(std::size_t size, const PackVertices& pack,
                            const std::function<void(std::string_view)>& take_some) const {
  const Ranges ranges(mesh_);
  for (std::size_t i = 0; i < ranges.count(); ++i) {
    const std::vector<std::string> came = send_to_first(collect(ranges, i, size, pack));
    std::size_t bytes = 0;
    for (const std::string& from : came) bytes += from.size();
    std::vector<PlacedBytes> range;
    range.reserve(bytes / (sizeof(VertexId) + size));
    for (const std::string& from : came) {
      for (std::string_view rest = from; !rest.empty();) {
        take(rest, range.emplace_back().id);
        range.back().at = take_front(rest, size).data();
      }
    }
    if (range.empty()) continue;
    std::sort(range.begin(), range.end(),
              [](const PlacedBytes& a, const PlacedBytes& b) { return a.id < b.id; });
    constexpr std::size_t kSome = std::size_t{1} << 16;
    for (std::size_t begin = 0; begin < range.size(); begin += kSome) {
      std::string in_order;
      for (std::size_t v = begin; v < std::min(begin + kSome, range.size()); ++v) {
        in_order.append(range[v].at, size);
      }
      take_some(in_order);
    }
  }
}

/// Each begins with the id of its vertex.
std::string FileWalk::collect(const Ranges& ranges, std::size_t number, std::size_t size,
                              const PackVertices& pack) const {
  std::string bytes;
  for (std::size_t i = 0; i < mesh_.own().size(); ++i) {
    const auto [begin, end] = ranges.of_piece(i, number);
    const std::size_t part = mesh_.own()[i];
    const Piece piece = mesh_.stored_vertices(part, begin, end);
    const std::string packed = pack(part, begin, piece);
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      if ((piece.marks[v] & kOwn) == 0) continue;
      put(piece.ids[v], bytes);
      bytes.append(packed, v * size, size);
    }
  }
  return bytes;
}

void FileWalk::vertices(const std::function<void(std::span<const FileVertex>)>& take_some) const {
  const auto pack = [](std::size_t, std::size_t, const Piece& piece) {
    std::string bytes;
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      const Point& p = piece.points[v];
      put(FileVertex{{p.x(), p.y(), p.z()}, piece.label(v)}, bytes);
    }
    return bytes;
  };
  vertex_bytes(sizeof(FileVertex), pack, [&](std::string_view bytes) {
    std::vector<FileVertex> vertices(bytes.size() / sizeof(FileVertex));
    for (FileVertex& vertex : vertices) take(bytes, vertex);
    take_some(vertices);
  });
}

void write_by_first(const std::filesystem::path& file, Ranks& ranks,
                    const std::function<void(OutputFile* out)>& write) {
  std::optional<OutputFile> out;
  if (ranks.is_first()) out.emplace(file);
  write(out ? &*out : nullptr);
  if (out) out->commit();
  ranks.meet();
}

}  // namespace tetmend::pieces
