// SPDX-License-Identifier: MIT
#include "kernel/formats/vtk_roles.h"

#include <array>

namespace tetmend::formats {
namespace {

constexpr std::string_view kOfPoints = "PointData ";
constexpr std::string_view kOfCells = "CellData ";

bool is_of_vtk(const MeshData& mesh) {
  return mesh.variant == kVtkAscii || mesh.variant == kVtkBinary;
}

}  // namespace

std::span<const std::string_view> vtk_roles() {
  static constexpr std::array<std::string_view, 8> kRoles = {"Scalars",   "Vectors",    "Normals",
                                                             "TCoords",   "Tensors",    "Tangents",
                                                             "GlobalIds", "PedigreeIds"};
  return kRoles;
}

bool is_id_role(std::string_view role) {
  return role == "GlobalIds" || role == "PedigreeIds";
}

void keep_role(MeshData& mesh, const VtkRole& role) {
  std::string piece(role.of_points ? kOfPoints : kOfCells);
  mesh.deck.push_back(piece + role.role + ' ' + role.array);
}

std::vector<VtkRole> roles_of(const MeshData& mesh) {
  std::vector<VtkRole> roles;
  if (!is_of_vtk(mesh)) return roles;
  for (const std::string_view piece : mesh.deck) {
    const bool of_points = piece.starts_with(kOfPoints);
    const std::string_view rest = piece.substr((of_points ? kOfPoints : kOfCells).size());
    const std::size_t blank = rest.find(' ');
    roles.push_back(
        {of_points, std::string(rest.substr(0, blank)), std::string(rest.substr(blank + 1))});
  }
  return roles;
}

bool has_only_roles(const MeshData& mesh) {
  return is_of_vtk(mesh);
}

}  // namespace tetmend::formats
