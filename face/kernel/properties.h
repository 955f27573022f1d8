// SPDX-License-Identifier: MIT
// Named values of a program on tets and vertices, which follow every edit and its undo.
//
// An edit writes the slots of what it made. The values that were in these slots lie in a journal of
// their own type until the outermost transaction ends; a slot that only became free keeps its value.
// So nothing is copied for what an edit removes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tetmend/api.h>
#include <tetmend/data.h>

#include "kernel/edit.h"
#include "kernel/error.h"
#include "kernel/handles.h"
#include "kernel/tet_mesh.h"

namespace tetmend::kernel {

/// What the tets that an edit makes begin with, unless a function says it.
enum class NewTets : std::uint8_t {
  initial,   ///< the initial value
  inherited  ///< the value of the old tet that has the most vertices in common, the first of such
};

/// The value of a new tet, of those that the tets had which it replaces. The mesh holds the new tets
/// already. An exception undoes the edit and comes out of the call that made it.
template <class T>
using TetRule = std::function<T(std::span<const T> old, TetHandle made)>;

/// How a value lies in the arrays of a file: as so many numbers of one type. 0: not at all.
template <class T>
struct InFiles {
  static constexpr std::size_t kComponents = 0;
};
template <class T>
requires std::is_arithmetic_v<T>
struct InFiles<T> {
  static constexpr std::size_t kComponents = 1;
  using Number =
      std::conditional_t<std::is_floating_point_v<T>,
                         std::conditional_t<std::is_same_v<T, float>, float, double>,
                         std::conditional_t<(sizeof(T) < 4 || std::is_same_v<T, std::int32_t>),
                                            std::int32_t, std::int64_t>>;
  static const T& at(const T& value, std::size_t) { return value; }
  static void set(T& value, std::size_t, T number) { value = number; }
};
template <class T, std::size_t N>
requires std::is_arithmetic_v<T>
struct InFiles<std::array<T, N>> {
  static constexpr std::size_t kComponents = N;
  using Number = typename InFiles<T>::Number;
  static const T& at(const std::array<T, N>& value, std::size_t i) { return value[i]; }
  static void set(std::array<T, N>& value, std::size_t i, T number) { value[i] = number; }
};
template <>
struct InFiles<Point> {
  static constexpr std::size_t kComponents = 3;
  using Number = double;
  static double at(const Point& value, std::size_t i) {
    return value[static_cast<Eigen::Index>(i)];
  }
  static void set(Point& value, std::size_t i, double number) {
    value[static_cast<Eigen::Index>(i)] = number;
  }
};

/// Values by slot. No std::vector: that of bool has no addresses.
template <class T>
class Values {
 public:
  Values() = default;
  Values(const Values& other) : Values() {
    reserve(other.size_);
    for (std::size_t i = 0; i < other.size_; ++i) push_back(other[i]);
  }
  Values& operator=(const Values&) = delete;
  Values(Values&&) = delete;
  Values& operator=(Values&&) = delete;
  ~Values() = default;

  std::size_t size() const { return size_; }
  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  std::span<const T> all() const { return {values_.get(), size_}; }

  void reserve(std::size_t size) {
    if (size <= room_) return;
    const std::size_t room = size + size / 2;
    std::unique_ptr<T[]> next(new T[room]);
    for (std::size_t i = 0; i < size_; ++i) next[i] = std::move(values_[i]);
    values_ = std::move(next);
    room_ = room;
  }
  /// Never less than it is.
  void grow(std::size_t size, const T& value) {
    reserve(size);
    while (size_ < size) push_back(value);
  }
  void push_back(T value) {
    reserve(size_ + 1);
    values_[size_++] = std::move(value);
  }
  void cut(std::size_t size) { size_ = size; }
  /// Keeps those listed, in that order.
  void gather(std::span<const std::uint32_t> kept) {
    std::unique_ptr<T[]> next(new T[kept.size()]);
    for (std::size_t i = 0; i < kept.size(); ++i) next[i] = std::move(values_[kept[i]]);
    values_ = std::move(next);
    size_ = room_ = kept.size();
  }

 private:
  std::unique_ptr<T[]> values_;
  std::size_t size_ = 0;
  std::size_t room_ = 0;
};

/// What an edit did to the tets, for the arrays of the tets. Of an added vertex only `made` is there.
struct Replaced {
  std::span<const Journal::RemovedTet> old;
  std::span<const std::uint32_t> made;       ///< slots
  std::span<const std::uint32_t> inherited;  ///< for each of them the number of an old tet
};

/// The values of one property.
class TETMEND_API PropertyArray {
 public:
  explicit PropertyArray(std::string_view name, bool inherits) : name_(name), inherits_(inherits) {}
  virtual ~PropertyArray() = default;
  PropertyArray& operator=(const PropertyArray&) = delete;

  const std::string& name() const { return name_; }
  bool inherits() const { return inherits_; }

  /// Has a value for that many slots.
  virtual void grow(std::size_t slots) = 0;
  /// Finds the values of what was made, and makes room for the old ones. May throw; nothing is
  /// written.
  virtual void prepare(const Replaced& replaced) = 0;
  /// Writes them.
  virtual void write(std::span<const std::uint32_t> made) noexcept = 0;
  /// Writes those that were there before.
  virtual void take_back(std::span<const std::uint32_t> made) noexcept = 0;
  virtual void forget() noexcept = 0;
  virtual void gather(std::span<const std::uint32_t> kept) = 0;
  virtual std::unique_ptr<PropertyArray> clone() const = 0;
  /// Values of an array of a Mesh. @param numbers in it, by slot; kNoNumber: none
  /// @throws Error where they do not fit
  virtual void read(const DataArray& from, std::span<const std::uint32_t> numbers) = 0;
  /// An array of a Mesh, of these slots in turn.
  virtual DataArray to_data(std::span<const std::uint32_t> slots) const = 0;
  /// The value as a number; NaN for a slot without one, and where values are no numbers.
  virtual double number(std::size_t slot) const = 0;
  virtual bool has_numbers() const = 0;
  static constexpr std::uint32_t kNoNumber = 0xFFFFFFFFu;
  bool is_in_files = false;  ///< TetMesh::to_mesh() writes it

 protected:
  PropertyArray(const PropertyArray&) = default;
  [[noreturn]] void refuse(const DataArray& from, std::size_t components) const;
  [[noreturn]] void refuse(std::uint32_t number, double value) const;

 private:
  std::string name_;
  bool inherits_ = false;
};

template <class T>
class ArrayOf final : public PropertyArray {
 public:
  static_assert(std::is_default_constructible_v<T> && std::is_copy_constructible_v<T>);
  static_assert(std::is_nothrow_move_assignable_v<T>, "undo must not fail");

  ArrayOf(std::string_view name, T initial, bool inherits, TetRule<T> rule)
      : PropertyArray(name, inherits), initial_(std::move(initial)), rule_(std::move(rule)) {}
  ArrayOf(const ArrayOf&) = default;

  void grow(std::size_t slots) override { values.grow(slots, initial_); }
  void prepare(const Replaced& replaced) override {
    journal_.reserve(journal_.size() + replaced.made.size());
    fresh_.cut(0);
    if (rule_ && !replaced.old.empty()) return ask_rule(replaced);
    const bool copies = inherits() && !replaced.inherited.empty();
    for (std::size_t k = 0; k < replaced.made.size(); ++k) {
      fresh_.push_back(copies ? values[replaced.old[replaced.inherited[k]].tet.index()] : initial_);
    }
  }
  void write(std::span<const std::uint32_t> made) noexcept override {
    for (std::size_t k = 0; k < made.size(); ++k) {
      journal_.push_back(std::move(values[made[k]]));
      values[made[k]] = std::move(fresh_[k]);
    }
  }
  void take_back(std::span<const std::uint32_t> made) noexcept override {
    const std::size_t first = journal_.size() - made.size();
    for (std::size_t k = made.size(); k-- > 0;) values[made[k]] = std::move(journal_[first + k]);
    journal_.cut(first);
  }
  void forget() noexcept override { journal_.cut(0); }
  void gather(std::span<const std::uint32_t> kept) override { values.gather(kept); }
  std::unique_ptr<PropertyArray> clone() const override { return std::make_unique<ArrayOf>(*this); }
  void read(const DataArray& from, std::span<const std::uint32_t> numbers) override {
    if (from.components != InFiles<T>::kComponents) refuse(from, InFiles<T>::kComponents);
    if constexpr (InFiles<T>::kComponents > 0) {
      std::visit([&](const auto& all) { read_from(all, numbers); }, from.values);
    }
  }
  DataArray to_data(std::span<const std::uint32_t> slots) const override {
    DataArray out{.name = name(), .components = InFiles<T>::kComponents, .values = {}};
    if constexpr (InFiles<T>::kComponents > 0) {
      using Number = typename InFiles<T>::Number;
      std::vector<Number> numbers;
      numbers.reserve(slots.size() * out.components);
      for (const std::uint32_t slot : slots) {
        for (std::size_t i = 0; i < out.components; ++i) {
          numbers.push_back(static_cast<Number>(InFiles<T>::at(values[slot], i)));
        }
      }
      out.values = std::move(numbers);
    }
    return out;
  }
  double number(std::size_t slot) const override {
    if constexpr (kHasNumbers) {
      if (slot < values.size()) return static_cast<double>(values[slot]);
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
  bool has_numbers() const override { return kHasNumbers; }

  Values<T> values;

 private:
  static constexpr bool kHasNumbers = std::is_arithmetic_v<T>;

  template <class Numbers>
  void read_from(const Numbers& all, std::span<const std::uint32_t> numbers) {
    constexpr std::size_t kComponents = InFiles<T>::kComponents;
    using Own = std::decay_t<decltype(InFiles<T>::at(initial_, 0))>;
    for (std::size_t slot = 0; slot < numbers.size(); ++slot) {
      if (numbers[slot] == kNoNumber) continue;
      for (std::size_t i = 0; i < kComponents; ++i) {
        const auto number = all[kComponents * numbers[slot] + i];
        // Real numbers may be rounded; whole ones are what they are, and converted where they fit alone.
        const auto real = static_cast<double>(number);
        bool fits = true;
        if constexpr (!std::is_floating_point_v<Own>) {
          fits = real >= static_cast<double>(std::numeric_limits<Own>::lowest()) &&
                 real <= static_cast<double>(std::numeric_limits<Own>::max()) &&
                 static_cast<double>(static_cast<Own>(number)) == real;
        }
        if (!fits) refuse(numbers[slot], real);
        InFiles<T>::set(values[slot], i, static_cast<Own>(number));
      }
    }
  }
  void ask_rule(const Replaced& replaced) {
    old_.cut(0);
    for (const Journal::RemovedTet& old : replaced.old) old_.push_back(values[old.tet.index()]);
    for (const std::uint32_t made : replaced.made) {
      fresh_.push_back(rule_(old_.all(), TetHandle(made)));
    }
  }

  T initial_;
  TetRule<T> rule_;
  Values<T> journal_;      // of slots that were written, in turn
  Values<T> fresh_, old_;  // of the edit at hand
};

/// The properties of one kind of entity.
class TETMEND_API PropertyTable {
 public:
  PropertyTable() = default;
  PropertyTable(const PropertyTable& other);
  PropertyTable& operator=(const PropertyTable&) = delete;

  bool empty() const { return arrays_.empty(); }
  /// Null: there is none of that name.
  PropertyArray* find(std::string_view name) const;
  PropertyArray& add(std::unique_ptr<PropertyArray> array) {
    arrays_.push_back(std::move(array));
    return *arrays_.back();
  }
  bool remove(std::string_view name);
  std::span<const std::unique_ptr<PropertyArray>> all() const { return arrays_; }

 private:
  std::vector<std::unique_ptr<PropertyArray>> arrays_;
};

/// Keeps all properties of a mesh in step with its edits, of whoever makes them. What goes wrong on
/// the way, where nothing may be thrown, it keeps for the caller, who undoes the edit.
class TETMEND_API PropertyKeeper final : public EditListener {
 public:
  PropertyKeeper() = default;
  /// The same properties. Precondition: no transaction is open.
  PropertyKeeper(const PropertyKeeper& other) : tets(other.tets), vertices(other.vertices) {}

  PropertyTable tets, vertices;

  bool is_needed() const { return !tets.empty() || !vertices.empty(); }
  /// Who is to be told of edits as well; null: nobody.
  void set_next(EditListener* next) { next_ = next; }
  /// The property that says which vertices are locked; null: none is.
  void set_locks(const ArrayOf<bool>* locks) { locks_ = locks; }
  /// What went wrong before, and was dealt with, is no concern of the edits that follow.
  void start() noexcept {
    touched_lock_ = false;
    if (missed_ == 0) failure_ = nullptr;
  }
  /// An edit since start() or the last call has moved or removed a locked vertex.
  bool take_touched_lock() { return std::exchange(touched_lock_, false); }
  /// Throws what went wrong in an edit that is undone by now, if anything did.
  void rethrow();
  bool has_failed() const { return failure_ != nullptr; }
  /// Nothing of what was done can be undone any more.
  void forget() noexcept;

  void edit_made(const tetmend::TetMesh& mesh, const Journal& journal) noexcept override;
  void edit_undone() noexcept override;

 private:
  void follow(const tetmend::TetMesh& mesh, const Journal& journal);
  void write(const PropertyTable& table, const Replaced& replaced, std::size_t slots);
  void note_lock(const Edit& edit);

  struct Step {
    const PropertyTable* table = nullptr;  // whose slots were written; null: none
    std::size_t first_slot = 0;            // in slots_
  };
  EditListener* next_ = nullptr;
  const ArrayOf<bool>* locks_ = nullptr;
  bool touched_lock_ = false;
  std::vector<Step> steps_;  // edits that may be undone
  std::vector<std::uint32_t> slots_;
  std::vector<std::uint32_t> inherited_;
  std::exception_ptr failure_;
  std::size_t missed_ = 0;  // edits since the failure
};

/// A property of tets or vertices. A small value; valid as long as the mesh and the property.
template <class HandleType, class T>
class Property {
 public:
  Property() = default;
  explicit Property(ArrayOf<T>& array) : array_(&array) {}

  /// Precondition: the handle is one of the mesh.
  T& operator[](HandleType entity) const { return array_->values[entity.index()]; }
  /// By HandleType::index(): also of slots that are deleted, whose values mean nothing. Valid until
  /// an edit makes tets or vertices.
  std::span<T> values() const { return {array_->values.data(), array_->values.size()}; }
  const std::string& name() const { return array_->name(); }

 private:
  ArrayOf<T>* array_ = nullptr;
};

template <class T>
using TetProperty = Property<TetHandle, T>;
template <class T>
using VertexProperty = Property<VertexHandle, T>;

}  // namespace tetmend::kernel
