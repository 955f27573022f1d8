// SPDX-License-Identifier: MIT
// Named per-entity arrays that follow growth, deletion and garbage collection of the mesh.
#pragma once

#include <algorithm>
#include <any>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "kernel/error.h"

namespace tetmend {

/// Names a property of type T on one kind of entity. Cheap to copy; valid until the property is
/// removed.
template <class HandleType, class T>
class TETMEND_API PropertyHandle {
 public:
  PropertyHandle() = default;
  bool is_valid() const { return index_ != kInvalid; }

 private:
  template <class>
  friend class PropertyTable;
  static constexpr std::size_t kInvalid = static_cast<std::size_t>(-1);
  explicit PropertyHandle(std::size_t index) : index_(index) {}
  std::size_t index_ = kInvalid;
};

/// All properties of one kind of entity. A slot that is created or re-used starts with the default
/// value of each property; undo of a transaction brings the old value back.
template <class HandleType>
class TETMEND_API PropertyTable {
 public:
  PropertyTable() = default;
  PropertyTable(const PropertyTable& other) : size_(other.size_) {
    for (const auto& array : other.arrays_) arrays_.push_back(array ? array->clone() : nullptr);
  }
  PropertyTable& operator=(const PropertyTable& other) {
    PropertyTable copy(other);
    *this = std::move(copy);
    return *this;
  }
  PropertyTable(PropertyTable&&) noexcept = default;
  PropertyTable& operator=(PropertyTable&&) noexcept = default;
  ~PropertyTable() = default;

  /// Precondition: no transaction is open.
  /// @throws Error if a property of that name exists.
  template <class T>
  PropertyHandle<HandleType, T> add(std::string_view name, T initial) {
    static_assert(std::is_nothrow_move_assignable_v<T>, "undo must not fail");
    for (const auto& array : arrays_) {
      if (array && array->name == name) {
        throw Error("property '" + std::string(name) + "' exists already");
      }
    }
    auto array = std::make_unique<Array<T>>();
    array->name = name;
    array->initial = std::move(initial);
    array->resize(size_);
    arrays_.push_back(std::move(array));
    return PropertyHandle<HandleType, T>(arrays_.size() - 1);
  }
  /// The property of that name and type; an invalid handle when there is none.
  template <class T>
  PropertyHandle<HandleType, T> find(std::string_view name) const {
    for (std::size_t i = 0; i < arrays_.size(); ++i) {
      if (arrays_[i] && arrays_[i]->name == name && dynamic_cast<Array<T>*>(arrays_[i].get())) {
        return PropertyHandle<HandleType, T>(i);
      }
    }
    return {};
  }
  template <class T>
  void remove(PropertyHandle<HandleType, T> handle) {
    arrays_[handle.index_].reset();
  }
  template <class T>
  T& at(PropertyHandle<HandleType, T> handle, HandleType entity) {
    return static_cast<Array<T>&>(*arrays_[handle.index_]).values[entity.index()].value;
  }
  template <class T>
  const T& at(PropertyHandle<HandleType, T> handle, HandleType entity) const {
    return static_cast<const Array<T>&>(*arrays_[handle.index_]).values[entity.index()].value;
  }

  // The rest is for the mesh and its transactions.
  bool empty() const { return arrays_.empty(); }
  /// When memory runs out, the size is what it was.
  void resize(std::size_t size) {
    try {
      for (auto& array : arrays_) {
        if (array) array->resize(size);
      }
    } catch (...) {
      shrink(size_);
      throw;
    }
    size_ = size;
  }
  /// Precondition: not larger than it is.
  void shrink(std::size_t size) noexcept {
    for (auto& array : arrays_) {
      if (array) array->shrink(size);
    }
    size_ = size;
  }
  std::vector<std::any> save(HandleType entity) const {
    std::vector<std::any> values;
    for (const auto& array : arrays_)
      values.push_back(array ? array->get(entity.index()) : std::any());
    return values;
  }
  /// What a new entity has.
  std::vector<std::any> initial() const {
    std::vector<std::any> values;
    for (const auto& array : arrays_) values.push_back(array ? array->get_initial() : std::any());
    return values;
  }
  /// Gives an entity what save() or initial() returned.
  void restore(HandleType entity, std::vector<std::any>&& values) noexcept {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (arrays_[i] && values[i].has_value()) arrays_[i]->take(entity.index(), values[i]);
    }
  }
  /// Keeps the entities listed, in that order.
  void gather(std::span<const std::uint32_t> kept) {
    size_ = kept.size();
    for (auto& array : arrays_) {
      if (array) array->gather(kept);
    }
  }

 private:
  struct ArrayBase {
    std::string name;
    virtual ~ArrayBase() = default;
    virtual void resize(std::size_t size) = 0;
    virtual void shrink(std::size_t size) noexcept = 0;
    virtual std::any get(std::size_t i) const = 0;
    virtual std::any get_initial() const = 0;
    virtual void take(std::size_t i, std::any& value) noexcept = 0;
    virtual void gather(std::span<const std::uint32_t> kept) = 0;
    virtual std::unique_ptr<ArrayBase> clone() const = 0;
  };
  template <class T>
  struct Array final : ArrayBase {
    struct Cell {  // keeps vector<bool> out
      T value;
    };
    T initial{};
    std::vector<Cell> values;

    void resize(std::size_t size) override { values.resize(size, Cell{initial}); }
    void shrink(std::size_t size) noexcept override {
      while (values.size() > size) values.pop_back();
    }
    std::any get(std::size_t i) const override { return values[i].value; }
    std::any get_initial() const override { return initial; }
    void take(std::size_t i, std::any& value) noexcept override {
      values[i].value = std::move(*std::any_cast<T>(&value));
    }
    void gather(std::span<const std::uint32_t> kept) override {
      std::vector<Cell> next;
      next.reserve(kept.size());
      for (const std::uint32_t i : kept) next.push_back(std::move(values[i]));
      values = std::move(next);
    }
    std::unique_ptr<ArrayBase> clone() const override { return std::make_unique<Array>(*this); }
  };

  std::size_t size_ = 0;
  std::vector<std::unique_ptr<ArrayBase>> arrays_;
};

}  // namespace tetmend
