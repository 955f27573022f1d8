// SPDX-License-Identifier: MIT
// What walks over a mesh return, and ranges over all of its live entities.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "kernel/handles.h"
#include "kernel/shell.h"
#include "kernel/star.h"

namespace tetmend::kernel {

class TetMesh;

using tetmend::Few;
using tetmend::Link;
using tetmend::OneRing;
using tetmend::Ring;
using tetmend::Star;

/// The tets behind the faces of one: four, or fewer at the boundary.
class Neighbours {
 public:
  /// None.
  Neighbours() = default;
  explicit Neighbours(const std::array<HalfFace, 4>& twins) : twins_(twins) {}

  class Iterator {
   public:
    using value_type = TetHandle;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    using reference = TetHandle;
    using pointer = void;

    Iterator() = default;
    Iterator(const HalfFace* next, const HalfFace* end) : next_(next), end_(end) { skip(); }
    TetHandle operator*() const { return next_->tet(); }
    Iterator& operator++() {
      ++next_;
      skip();
      return *this;
    }
    Iterator operator++(int) {
      const Iterator old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.next_ == b.next_; }

   private:
    void skip() {
      while (next_ != end_ && next_->is_outside()) ++next_;
    }
    const HalfFace* next_ = nullptr;
    const HalfFace* end_ = nullptr;
  };

  Iterator begin() const { return {twins_.data(), twins_.data() + 4}; }
  Iterator end() const { return {twins_.data() + 4, twins_.data() + 4}; }
  std::size_t size() const { return static_cast<std::size_t>(std::distance(begin(), end())); }

 private:
  std::array<HalfFace, 4> twins_;
};

/// Lists for all vertices at once: rows[v] is that of a vertex, empty for one of no tet or one that the
/// mesh did not have yet.
template <class T>
struct Rows {
  std::vector<std::size_t> begin;  ///< by slot of a vertex, and one more
  std::vector<T> values;
  std::span<const T> operator[](VertexHandle v) const {
    if (v.index() + 1 >= begin.size()) return {};
    return {values.data() + begin[v.index()], begin[v.index() + 1] - begin[v.index()]};
  }
};

/// The live entities of one kind, by slot. What a loop makes in slots that were there when it began
/// may be visited, what it makes behind them is not. Many passes may be made over one range.
template <class HandleType, class IsWanted>
class LiveRange {
 public:
  LiveRange(const TetMesh& mesh, std::uint32_t end) : mesh_(&mesh), end_(end) {}

  class Iterator {
   public:
    using value_type = HandleType;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    using reference = HandleType;
    using pointer = void;

    Iterator() = default;
    HandleType operator*() const { return IsWanted::handle(code_); }
    Iterator& operator++() {
      ++code_;
      skip();
      return *this;
    }
    Iterator operator++(int) {
      const Iterator old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.code_ == b.code_; }

   private:
    friend class LiveRange;
    Iterator(const TetMesh* mesh, std::uint32_t code, std::uint32_t end)
        : mesh_(mesh), code_(code), end_(end) {
      skip();
    }
    void skip() {
      while (code_ < end_ && !IsWanted::is_wanted(*mesh_, code_)) ++code_;
    }
    const TetMesh* mesh_ = nullptr;
    std::uint32_t code_ = 0;
    std::uint32_t end_ = 0;
  };

  Iterator begin() const { return {mesh_, 0, end_}; }
  Iterator end() const { return {mesh_, end_, end_}; }

 private:
  const TetMesh* mesh_;
  std::uint32_t end_;
};

// What each kind of range visits.
struct LiveTet {
  static TetHandle handle(std::uint32_t code) { return TetHandle(code); }
  static bool is_wanted(const TetMesh& mesh, std::uint32_t code);
};
struct LiveVertex {
  static VertexHandle handle(std::uint32_t code) { return VertexHandle(code); }
  static bool is_wanted(const TetMesh& mesh, std::uint32_t code);
};
struct LiveFace {
  static HalfFace handle(std::uint32_t code) { return HalfFace::from_code(code); }
  static bool is_wanted(const TetMesh& mesh, std::uint32_t code);
};
struct BoundaryFace {
  static HalfFace handle(std::uint32_t code) { return HalfFace::from_code(code); }
  static bool is_wanted(const TetMesh& mesh, std::uint32_t code);
};

/// The edges that a mesh had when they were listed and still has, each once, as a live tet names it:
/// a loop may edit. Takes 12 bytes an edge.
class TETMEND_API Edges {
 public:
  /// An edge by its ends, and a tet that it was seen in.
  struct Entry {
    VertexHandle a;
    VertexHandle b;
    TetEdge edge;
  };
  Edges(const TetMesh& mesh, std::vector<Entry> entries)
      : mesh_(&mesh), entries_(std::move(entries)) {}

  /// Number of the edges that were listed.
  std::size_t size() const { return entries_.size(); }

  class TETMEND_API Iterator {
   public:
    using value_type = TetEdge;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    using reference = TetEdge;
    using pointer = void;

    Iterator() = default;
    TetEdge operator*() const { return current_; }
    Iterator& operator++() {
      ++next_;
      skip();
      return *this;
    }
    Iterator operator++(int) {
      const Iterator old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.next_ == b.next_; }

   private:
    friend class Edges;
    Iterator(const TetMesh* mesh, const Entry* next, const Entry* end)
        : mesh_(mesh), next_(next), end_(end) {
      skip();
    }
    void skip();  // over edges that are gone

    const TetMesh* mesh_ = nullptr;
    const Entry* next_ = nullptr;
    const Entry* end_ = nullptr;
    TetEdge current_;
  };

  Iterator begin() const { return {mesh_, entries_.data(), entries_.data() + entries_.size()}; }
  Iterator end() const {
    const Entry* end = entries_.data() + entries_.size();
    return {mesh_, end, end};
  }

 private:
  const TetMesh* mesh_;
  std::vector<Entry> entries_;
};

}  // namespace tetmend::kernel
