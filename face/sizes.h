// SPDX-License-Identifier: MIT
// The lengths that the options want edges to have.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tetmend/improve.h>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"
#include "kernel/wanted_lengths.h"
#include "schedule/lua_function.h"

namespace tetmend::face {

/// Options::size and what belongs to it, looked through.
class Sizes {
 public:
  /// @throws OptionError for a size that has none of the forms, or bounds without sense
  explicit Sizes(const Options& options);

  bool are_wanted() const { return !specs_.empty() || function_; }
  /// One of Options::size that only the whole mesh tells: an array of its own, a factor, a region, a size
  /// beside others. Empty: the lengths are of places.
  std::string of_mesh() const;
  /// The file that has these lengths; empty: none.
  std::string file_of_places() const {
    return of_mesh().empty() && !specs_.empty() ? specs_[0].file : std::string();
  }
  /// The field where they are of places, for a mesh in the lengths of its file. Precondition: of_mesh() is empty.
  /// @throws Error for a file or array that cannot be used
  std::shared_ptr<const WantedLengths> field_of_places() const;
  /// The field. Lengths at points of the mesh are linear in its tets.
  /// @param data the mesh as its file has it, but in the lengths of `mesh`; must outlive the field
  /// @throws Error for a file or array that cannot be used, OptionError for a label that no tet has
  /// Cost: about n log n.
  std::shared_ptr<const WantedLengths> field(const MeshData& data, const TetMesh& mesh) const;

  /// "array:h", "h.sol", "coarse.vtu:h", "h.lua", "0.5", "0.5x", one of them behind "label:1,4=".
  struct Spec {
    enum class Kind { constant, factor, array, file, background, function };
    std::string text;  ///< as the user wrote it
    Kind kind = Kind::constant;
    double number = 0;                            ///< of a constant or factor
    std::string file;                             ///< of lengths, or a background mesh
    std::string name;                             ///< of an array
    std::shared_ptr<const LuaFunction> function;  ///< "size" of a script
    std::vector<Label> labels;                    ///< of the regions; empty: everywhere
  };

 private:
  using Function = std::function<double(double, double, double)>;

  bool is_alone(Spec::Kind kind) const;
  std::shared_ptr<const WantedLengths> field_of(Function function, std::string name,
                                                const Scale& scale) const;
  std::shared_ptr<const WantedLengths> field_of_places(const Scale& scale) const;
  double rate() const { return gradation_ > 0 ? gradation_ - 1 : 0; }
  double clamped(double length) const;

  std::vector<Spec> specs_;
  Function function_;
  double gradation_;
  double smallest_;
  double largest_;
};

}  // namespace tetmend::face
