// SPDX-License-Identifier: MIT
// The operators and measures that exist, by name. Passed down; there is no global registry.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/api.h>

#include "ops/operator.h"

namespace tetmend {

class TETMEND_API Registry {
 public:
  /// The operators of tetmend itself.
  static Registry builtin();

  /// @param origin file of the plugin that the operator comes from; empty for tetmend itself
  /// @throws Error if there is an operator of that name, or if name, help, parameters or `make`
  /// make no sense. `info` must outlive the registry.
  void add(const OperatorInfo& info, std::string_view origin = {});

  /// For operators that one function makes, with what it knows.
  using Maker = std::function<std::unique_ptr<Operator>(const ParameterValues&)>;
  /// The same, of the program itself; `info.make` is not asked. It may look anywhere: passes make one part
  /// of the mesh from now on.
  void add(const OperatorInfo& info, Maker make);

  /// A measure that options and schedules may name: Standard::of(...).
  /// @throws Error if there is one of that name
  void add_measure(const Standard& own);
  /// Those that were added.
  std::span<const Standard> measures() const { return measures_; }
  /// The standard of a measure by its name: "sine", "sine_and_length", or one that was added.
  /// @throws Error for an unknown name, with the valid ones
  Standard standard(std::string_view measure, const Goal& goal, double price) const;

  /// An operator may look anywhere: parts of a mesh cannot be worked on at the same time.
  bool needs_whole_mesh() const { return needs_whole_mesh_; }

  /// In the order of registration.
  std::span<const OperatorInfo* const> operators() const { return infos_; }

  /// @throws Error for an unknown name, with the valid ones.
  const OperatorInfo& find(std::string_view name) const;
  /// Where the operator comes from, see add(). @throws Error for an unknown name.
  const std::string& origin(std::string_view name) const;

  /// @throws Error for an unknown operator or parameter, a value out of range, or an operator of a
  /// plugin that cannot be made.
  std::unique_ptr<Operator> make(std::string_view name,
                                 const ParameterSettings& settings = {}) const;

  /// From now on make() gives a parameter this value, whatever it is asked for.
  /// @throws Error for an unknown operator or parameter, or a value out of range.
  void hold(std::string_view name, std::string_view parameter, double value);

 private:
  void add(const OperatorInfo& info, std::string_view origin, Maker make);
  std::size_t index_of(std::string_view name) const;

  std::vector<const OperatorInfo*> infos_;
  std::vector<std::string> origins_;
  std::vector<Maker> makers_;
  std::vector<Standard> measures_;
  bool needs_whole_mesh_ = false;
  std::vector<ParameterSettings> held_;  // of each operator
};

}  // namespace tetmend
