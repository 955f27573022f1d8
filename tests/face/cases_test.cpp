// SPDX-License-Identifier: MIT
// Inputs that people have, each with what must hold of it: one row for each file of tests/cases.
//
// A row names its kind:
//   O  values from a part that overlaps           P  numbers in decks that are no nodes
//   V  listings and numbers that `check` takes    M  mixed listings and inverted tets at once
//   T  degenerate elements                        N  points that touch without being joined
//   A  decks as Abaqus/CAE writes them            F  flavours of formats
//   I  identifiers, which are no fields           L  which array of VTK holds the regions
//   W  written so that others read it again       C  curved tets that are turned over
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/check.h>
#include <tetmend/improve.h>
#include <tetmend/io.h>
#include <tetmend/measure.h>

#include "kernel/geometry.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// What is not given is not asked. Of each case, the improved mesh, written and read again, keeps
/// all that compare() looks at.
struct Case {
  std::string_view file = {};
  char kind = ' ';
  std::optional<std::size_t> tets = {};      ///< as read
  std::optional<std::size_t> required = {};  ///< vertices that must stay, as read
  std::optional<std::size_t> inverted = {};  ///< or flat, before; afterwards there is none
  std::optional<std::size_t> bad = {};       ///< before
  std::optional<std::size_t> bad_after = {};
  std::string_view note = {};                    ///< part of a note of the file or of the run
  bool has_notes = true;                         ///< false: there must be none
  std::string_view refused = {};                 ///< part of the error that improve() has
  std::map<std::int32_t, double> volumes = {};   ///< by label, afterwards
  std::string_view array = {};                   ///< of the tets
  std::map<std::int32_t, double> of_label = {};  ///< its value in every tet of a label, afterwards
  std::string_view identifiers = {};  ///< an array: what is left keeps its number, no two are alike
  std::vector<std::string_view> regions = {};  ///< arrays or "label": each value keeps its volume
  std::vector<std::string_view> written = {};  ///< what the improved file has
  std::string_view not_written = {};           ///< and what it has not
};

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases = {
      {.file = "overlapping-parts.msh", .kind = 'O', .volumes = {{1, 8}, {2, 5.832}}},
      {.file = "overlapping-arrays.vtu",
       .kind = 'O',
       .array = "young",
       .of_label = {{1, 70}, {2, 210}}},

      {.file = "surface-by-number.inp", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "numbers-of-elements.inp", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "conditions-of-elements.inp", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "terms-of-an-equation.inp", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "node-in-an-equation.inp",
       .kind = 'P',
       .required = 1,
       .note = "node-in-an-equation.inp:83: *EQUATION keeps 1 point where it is"},
      {.file = "set-of-one-node.inp",
       .kind = 'P',
       .required = 1,
       .note = "set-of-one-node.inp:78: the set of nodes 'probe' keeps 1 point where it is"},
      {.file = "card-numbers.bdf",
       .kind = 'P',
       .required = 1,
       .bad = 5,
       .bad_after = 0,
       .note = ":79: FORCE keeps 1 point where it is"},
      {.file = "grid-with-cd-0.bdf", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "grid-without-cd.bdf", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "grid-with-constraints.bdf",
       .kind = 'P',
       .required = 1,
       .note = ":15: GRID with constraints in field 8 keeps 1 point where it is"},
      {.file = "numbers-of-sets.bdf", .kind = 'P', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "numbers-of-springs.bdf",
       .kind = 'P',
       .required = 7,  // 1 to 5, 7 and 8
       .note = ":86: SPC1 keeps 3 points where they are"},
      {.file = "point-in-a-long-list.bdf",
       .kind = 'P',
       .required = 2,
       .note = ":79: SPC1 keeps 2 points where they are"},
      {.file = "unknown-card.bdf",
       .kind = 'P',
       .required = 2,
       .note = "NOSUCH, a card whose fields are not known, keeps 2 points where they are"},

      {.file = "listed-mirrored.mesh", .kind = 'V', .inverted = 0, .bad_after = 0},
      {.file = "surface-by-set.inp", .kind = 'V', .required = 0, .bad = 5, .bad_after = 0},
      {.file = "listed-both-ways.mesh", .kind = 'V', .inverted = 0, .bad = 5, .bad_after = 0},
      {.file = "listed-ascending.vtk", .kind = 'V', .inverted = 0, .bad = 5, .bad_after = 0},
      {.file = "one-part-mirrored.mesh",
       .kind = 'V',
       .inverted = 0,
       .bad = 10,
       .bad_after = 0,
       .volumes = {{1, 8}, {2, 8}}},
      {.file = "names-and-mirrored.msh", .kind = 'V', .inverted = 0, .bad = 5, .bad_after = 0},
      {.file = "second-order-mirrored.inp", .kind = 'V', .inverted = 0, .bad = 5, .bad_after = 0},
      {.file = "sets-and-loads.inp", .kind = 'V', .required = 0, .inverted = 0, .bad_after = 0},

      {.file = "mixed-and-inverted.mesh", .kind = 'M', .inverted = 2},
      {.file = "ascending-and-inverted.mesh", .kind = 'M', .inverted = 2},
      {.file = "mirrored-and-inverted.vtk", .kind = 'M', .inverted = 2},
      {.file = "parts-mirrored-and-inverted.mesh",
       .kind = 'M',
       .inverted = 4,
       .volumes = {{1, 8}, {2, 8}}},
      {.file = "first-is-inverted.bdf", .kind = 'M', .inverted = 2},
      {.file = "mixed-and-flat.mesh", .kind = 'M', .inverted = 6},

      {.file = "tet-twice.mesh", .kind = 'T', .tets = 48, .note = "tet 49 is tet 8 again: dropped"},
      {.file = "tet-with-a-vertex-twice.mesh",
       .kind = 'T',
       .tets = 48,
       .note = "has a vertex twice: dropped"},
      {.file = "edge-with-a-node-twice.msh",
       .kind = 'T',
       .tets = 48,
       .note = "has a vertex twice: dropped"},
      {.file = "tet-twice.vtk", .kind = 'T', .tets = 48, .note = "tet 49 is tet 8 again: dropped"},
      {.file = "corner-twice-second-order.inp",
       .kind = 'T',
       .tets = 48,
       .note = "tet 49 (vertices 1 1 5 14) has a vertex twice: dropped"},
      {.file = "elements-twice.bdf",
       .kind = 'T',
       .tets = 48,
       .note = "2 tets are there already, tet 49 is tet 3 again and so on: dropped"},
      {.file = "degenerate.msh",
       .kind = 'T',
       .tets = 48,
       .note = "triangle 1 (vertices 1 2 2) has a vertex twice: dropped"},
      {.file = "label-of-the-second.mesh",
       .kind = 'T',
       .tets = 48,
       .note = "tet 49 is tet 1 again, with label 2 instead of 1: dropped",
       .volumes = {{1, 8}}},
      {.file = "twice-and-mixed.mesh",
       .kind = 'T',
       .tets = 48,
       .inverted = 0,
       .note = "tet 49 is tet 10 again: dropped"},

      {.file = "not-joined.mesh", .kind = 'N', .note = "165 of 192 points lie on others"},
      {.file = "fine-beside-coarse.mesh",
       .kind = 'N',
       .note = "5 of 35 points lie on a face or an edge of others"},
      {.file = "two-boxes-not-joined.mesh", .kind = 'N', .note = "9 of 54 points lie on others"},
      {.file = "edge-beside-an-edge.mesh",
       .kind = 'N',
       .note = "1 of 35 points lies on a face or an edge of others"},
      {.file = "slanted-and-hanging.mesh",
       .kind = 'N',
       .note = "5 of 35 points lie on a face or an edge of others"},
      {.file = "within-each-other.msh",
       .kind = 'N',
       .note = "18 of 35 points lie on a face or an edge of others"},
      {.file = "apart.mesh", .kind = 'N', .bad = 10, .bad_after = 0, .has_notes = false},

      {.file = "mesh-in-instance.inp", .kind = 'A', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "part-of-a-point.inp", .kind = 'A', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "two-parts.inp", .kind = 'A', .tets = 96, .volumes = {{1, 8}, {2, 8}}},
      {.file = "one-part-twice.inp", .kind = 'A', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "plate-beside.inp",
       .kind = 'A',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .note = "'PLATE' has no tetrahedra"},
      {.file = "byte-order-mark.inp", .kind = 'A', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "cae-coupling.inp",
       .kind = 'A',
       .tets = 48,
       .required = 0,
       .bad = 5,
       .bad_after = 0,
       .has_notes = false,
       .written = {"*End Instance\n**\n*Node\n      1, 1., 1., 5.\n*Nset, nset=_PickedSet5, "
                   "internal\n 1,\n",
                   "*Surface, type=ELEMENT, name=Top\nPart-1-1.", "*Dsload\nTop, P, 3.\n"}},
      {.file = "cae-same-names.inp",
       .kind = 'A',
       .tets = 96,
       .required = 0,
       .volumes = {{1, 8}, {2, 8}},
       .written =
           {"*Instance, name=\"P 2-1\", part=\"P 2\"\n7., 0., 0.\n7., 0., 0., 7., 0., 1., 90.\n",
            "*Elset, elset=All\nP1-1.Set-1, \"P 2-1\".Set-1\n"}},
      {.file = "cae-other-elements.inp",
       .kind = 'A',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .note = "'BEAM' has no tetrahedra",
       .written = {"*Element, type=MASS, elset=m\n101, 1\n",
                   "301, 1, 27\n*Spring, elset=sp\n\n10.\n", "1, solid-1.13, beam-1.1\n",
                   "BEAM, solid-1.27, beam-1.2\n"}},
      {.file = "hypermesh.inp",
       .kind = 'A',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .has_notes = false,
       .written = {"**HWCOLOR COMP          1    11\n", "*STEP, INC =       100, PERTURBATION\n"}},
      {.file = "prepomax.inp",
       .kind = 'A',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .written = {"*Element, Type=C3D10, Elset=Solid_part-1\n", "*El file\nS, E, NOE\n"}},
      {.file = "freecad.inp",
       .kind = 'A',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .written = {"27,3,-1.5\n*DLOAD\n211, P3,10.0\n"}},
      {.file = "gmsh.inp",
       .kind = 'A',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .written = {"*ELEMENT, type=T3D2, ELSET=Line1\n1, 1, 2\n2, 2, 3\n",
                   "*ELSET, ELSET=wall\n3, 4\n"}},
      {.file = "ordered-and-beyond.inp",
       .kind = 'A',
       .tets = 48,
       .required = 1,
       .note = "ends with 100, but the greatest number of an element is 48",
       .written = {"*NSET, NSET=order, UNSORTED\r\n14, 1\r\n** of all\r\n*ELSET, ELSET=all"}},

      {.file = "property-blank.bdf",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .volumes = {{0, 8}}},
      {.file = "comment-within-a-card.bdf", .kind = 'F', .tets = 1},
      {.file = "long-free-line.bdf", .kind = 'F', .tets = 1},
      {.file = "no-enddata.bdf", .kind = 'F', .tets = 1, .note = "have no ENDDATA"},
      {.file = "other-coordinates.bdf", .kind = 'F', .tets = 1, .volumes = {{1, 1.0 / 6}}},
      {.file = "included-mesh.bdf", .kind = 'F', .tets = 1},
      {.file = "included-mesh-bulk.bdf", .kind = 'F', .tets = 1, .note = "have no ENDDATA"},
      {.file = "tabs-and-cylinder.bdf", .kind = 'F', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "a-node-left-out.bdf",
       .kind = 'F',
       .tets = 47,
       .note = "1 CTETRA leave out some of their mid-side nodes"},
      {.file = "simcenter.bdf",
       .kind = 'F',
       .tets = 48,
       .required = 9,
       .bad = 5,
       .bad_after = 0,
       .note = ":363: SPC1 keeps 9 points where they are",
       .written = {"SET 1 = 1 THRU 14,\n  20\n", "$* $$$$ MODEL DATA\nPARAM   AUTOSPC YES\n",
                   "GRID*                  1               0 0.000000000E+00 0.000000000E+00+\n",
                   "\nENDDATA 3f2a\n"}},
      {.file = "femap.bdf",
       .kind = 'F',
       .tets = 48,
       .required = 0,
       .bad = 5,
       .bad_after = 0,
       .has_notes = false,
       .written = {"+FEMAPC1      1.      0.      1.\n",
                   "MAT1           1 2.1+11              .3   7850. 1.2-5\n"}},
      {.file = "ansa.bdf",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .has_notes = false,
       .written = {"$ANSA_VERSION;19\n", "$ANSA_NAME_COMMENT;1;PSOLID;steel;\n"}},
      {.file = "lower-case.bdf",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .note = "comments behind the fields of points and elements are not kept",
       .written = {"cend\nbegin bulk\n", "psolid,1,1\nmat1,1,2.1e5,,.3\nenddata\n"}},
      {.file = "constrained-by-default.bdf",
       .kind = 'F',
       .tets = 48,
       .required = 0,
       .bad = 5,
       .bad_after = 0},
      {.file = "systems-of-systems.bdf",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .volumes = {{1, 8}}},
      {.file = "with-parameters.msh",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .note = "the parameters of nodes are not kept"},
      {.file = "four-bytes.msh", .kind = 'F', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "middle-nodes-left-out.bdf",
       .kind = 'F',
       .tets = 0,
       .note = "1 CTETRA leave out some of their mid-side nodes",
       .refused = "the mesh has no tetrahedra"},
      {.file = "continued-elsewhere.bdf",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .has_notes = false},
      {.file = "superelement.bdf",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .note = "superelements stay as they are",
       .written = {"PSOLID,1,1\nBEGIN SUPER=1\nGRID,14,,0.,0.,9.\nCTETRA,1,1,1,2,3,14\nENDDATA\n"}},
      {.file = "name-over-two-lines.bdf", .kind = 'F', .tets = 1},
      {.file = "comments-first.msh",
       .kind = 'F',
       .tets = 48,
       .bad = 5,
       .bad_after = 0,
       .note = "section '$Comments' is not kept"},
      {.file = "names-without-quotes.msh", .kind = 'F', .tets = 48, .bad = 5, .bad_after = 0},
      {.file = "lz4.vtu", .kind = 'F', .tets = 96},

      {.file = "global-ids.vtu",
       .kind = 'I',
       .note = "'GlobalElementID' numbers tets",
       .identifiers = "GlobalElementID",
       .written = {"GlobalIds=\"GlobalNodeID\""}},
      {.file = "ids-by-keyword.vtk",
       .kind = 'I',
       .note = "'cells' numbers tets",
       .identifiers = "cells",
       .written = {"GLOBAL_IDS cells vtkIdType", "PEDIGREE_IDS nodes vtkIdType"}},
      {.file = "ids-as-reals.vtu",
       .kind = 'I',
       .note = "'GlobalElementID' numbers tets",
       .identifiers = "GlobalElementID",
       .written = {"<CellData GlobalIds=\"GlobalElementID\">",
                   "<PointData GlobalIds=\"GlobalNodeID\">"}},
      {.file = "ids-of-tets-and-faces.vtk",
       .kind = 'I',
       .note = "'element_id' numbers tets",
       .identifiers = "element_id"},
      {.file = "ids-in-any-order.vtu",
       .kind = 'I',
       .note = "'GlobalElementID' numbers tets",
       .identifiers = "GlobalElementID"},
      {.file = "ids-of-paraview.vtu",
       .kind = 'I',
       .note = "'vtkOriginalCellIds' numbers tets",
       .identifiers = "vtkOriginalCellIds"},
      {.file = "ids-beyond-32-bits.vtu",
       .kind = 'I',
       .note = "'ElementId' numbers tets",
       .identifiers = "ElementId"},
      {.file = "ids-without-a-name-for-them.vtu",
       .kind = 'I',
       .note = "'cells' numbers tets",
       .identifiers = "cells"},
      {.file = "ids-in-single-precision.vtu",
       .kind = 'I',
       .note = "'Element ID' numbers tets",
       .identifiers = "Element ID"},
      {.file = "ids-near-the-end.vtu",
       .kind = 'I',
       .note = "'PedigreeElementId' numbers tets",
       .identifiers = "PedigreeElementId"},

      {.file = "two-integer-arrays.vtk",
       .kind = 'L',
       .regions = {"label"},
       .written = {"attribute"}},
      {.file = "blocks-beside-ghosts.vtk",
       .kind = 'L',
       .has_notes = false,
       .regions = {"label"},
       .written = {"SCALARS ElementBlockIds int 1"}},
      {.file = "markers-as-doubles.vtk",
       .kind = 'L',
       .has_notes = false,
       .regions = {"label"},
       .written = {"SCALARS cell_markers int 1"}},
      {.file = "two-unknown-arrays.vtk",
       .kind = 'L',
       .note = "'zebra', 'crossing' might hold them, so faces between different values of any of "
               "them stay",
       .regions = {"zebra", "crossing"}},
      {.file = "three-arrays.vtu",
       .kind = 'L',
       .note = "'a', 'c' might hold them, so faces between different values of any of them stay",
       .regions = {"a", "c"}},
      {.file = "labels-of-faces-too.vtu",
       .kind = 'L',
       .note = "labels are those of 'attribute'; faces between different values of "
               "'ElementBlockIds' stay, too",
       .regions = {"label", "ElementBlockIds"}},
      {.file = "negative-labels.vtu", .kind = 'L', .has_notes = false, .regions = {"label"}},
      {.file = "single-precision-labels.vtu",
       .kind = 'L',
       .has_notes = false,
       .regions = {"label"}},
      {.file = "name-with-a-blank.vtu",
       .kind = 'L',
       .has_notes = false,
       .regions = {"label"},
       .written = {"Name=\"Region ID\""}},
      {.file = "body-and-object.vtu",
       .kind = 'L',
       .note =
           "labels are those of 'ObjectId'; faces between different values of 'body_id' stay, too",
       .regions = {"label", "body_id"}},
      {.file = "one-unknown-double.vtu",
       .kind = 'L',
       .has_notes = false,
       .regions = {"label"},
       .written = {"Name=\"zebra\""}},
      {.file = "divided.vtu", .kind = 'L', .has_notes = false, .regions = {"label"}},

      {.file = "ascii.vtk", .kind = 'W', .written = {"\nASCII\n"}},
      {.file = "long.vtk",
       .kind = 'W',
       .written = {"# vtk DataFile Version 3.0", "\nASCII\n"},
       .not_written = "vtktypeint64"},
      {.file = "sets-by-list.inp",
       .kind = 'W',
       .written = {"*ELSET, ELSET=left\n"},
       .not_written = "GENERATE"},
      {.file = "from-one.ele", .kind = 'W', .tets = 48, .written = {"\n1 "}, .not_written = "\n0 "},
  };
  return kCases;
}

const std::filesystem::path kFolder = std::filesystem::path(TETMEND_SOURCE_DIR) / "tests/cases";

std::map<std::int32_t, double> volumes_by_label(const MeshArrays& arrays) {
  std::map<std::int32_t, double> volumes;
  const auto point = [&](std::uint32_t v) {
    return Point(arrays.points[v][0], arrays.points[v][1], arrays.points[v][2]);
  };
  for (std::size_t t = 0; t < arrays.tets.size(); ++t) {
    const auto& [a, b, c, d] = arrays.tets[t];
    volumes[arrays.tet_labels[t]] += volume6(point(a), point(b), point(c), point(d)) / 6;
  }
  return volumes;
}

/// The values of an array of one number a tet, by the labels of the tets.
std::map<std::int32_t, std::set<double>> values_by_label(const Mesh& mesh, std::string_view name) {
  std::map<std::int32_t, std::set<double>> values;
  for (const DataArray& array : mesh.tet_data()) {
    if (array.name != name) continue;
    std::visit(
        [&](const auto& numbers) {
          for (std::size_t t = 0; t < numbers.size(); ++t) {
            values[mesh.arrays().tet_labels[t]].insert(static_cast<double>(numbers[t]));
          }
        },
        array.values);
  }
  return values;
}

void check_as_read(const Case& wanted, const Mesh& mesh) {
  if (wanted.tets) CHECK(mesh.tet_count() == *wanted.tets);
  if (wanted.required) CHECK(mesh.arrays().required_vertices.size() == *wanted.required);
}

void check_run(const Case& wanted, const Result& result) {
  CHECK(result.worse().empty());
  if (wanted.inverted) {
    CHECK(result.not_positive_before == *wanted.inverted);
    CHECK(result.not_positive_after == 0);
  }
  if (wanted.bad) CHECK(result.before.n_bad == *wanted.bad);
  if (wanted.bad_after) CHECK(result.after.n_bad == *wanted.bad_after);
}

void check_notes(const Case& wanted, const std::vector<std::string>& notes) {
  CAPTURE(notes);
  if (!wanted.has_notes) CHECK(notes.empty());
  const bool is_told = std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
    return note.find(wanted.note) != std::string::npos;
  });
  CHECK((wanted.note.empty() || is_told));
}

void check_values(const Case& wanted, const Mesh& mesh) {
  const auto volumes = volumes_by_label(mesh.arrays());
  for (const auto& each : wanted.volumes) {
    const auto label = each.first;
    CAPTURE(label);
    REQUIRE(volumes.contains(label));
    CHECK(volumes.at(label) == doctest::Approx(each.second));
  }
  const auto values = values_by_label(mesh, wanted.array);
  for (const auto& each : wanted.of_label) {
    const auto label = each.first;
    CAPTURE(label);
    REQUIRE(values.contains(label));
    CHECK(values.at(label) == std::set<double>{each.second});
  }
}

/// The numbers of an array of tets, whatever their type.
std::vector<std::int64_t> numbers_of(const Mesh& mesh, std::string_view name) {
  std::vector<std::int64_t> found;
  for (const DataArray& array : mesh.tet_data()) {
    if (array.name != name) continue;
    std::visit([&](const auto& values) { found.assign(values.begin(), values.end()); },
               array.values);
  }
  return found;
}

/// A tet that is left has the number that it had, and no two have the same.
void check_identifiers(const Case& wanted, const Mesh& before, const Mesh& after,
                       const Result& result) {
  if (wanted.identifiers.empty()) return;
  const std::vector<std::int64_t> then = numbers_of(before, wanted.identifiers);
  const std::vector<std::int64_t> now = numbers_of(after, wanted.identifiers);
  REQUIRE(then.size() == before.tet_count());
  REQUIRE(now.size() == after.tet_count());
  CHECK(std::set<std::int64_t>(now.begin(), now.end()).size() == now.size());
  const std::set<std::int64_t> old(then.begin(), then.end());
  std::vector<char> is_left(now.size(), 0);
  for (std::size_t t = 0; t < then.size(); ++t) {
    if (result.tet_map[t] == kGone) continue;
    is_left[result.tet_map[t]] = 1;
    CHECK(now[result.tet_map[t]] == then[t]);
  }
  for (std::size_t t = 0; t < now.size(); ++t) CHECK(old.contains(now[t]) == (is_left[t] != 0));
}

/// By value of an array, or by label.
std::map<double, double> volumes_by_value(const Mesh& mesh, std::string_view name) {
  std::map<double, double> volumes;
  if (name == "label") {
    for (const auto& [label, size] : volumes_by_label(mesh.arrays())) volumes[label] = size;
    return volumes;
  }
  const MeshArrays arrays = mesh.arrays();
  const std::vector<std::int64_t> values = numbers_of(mesh, name);
  MeshArrays by_value = arrays;
  by_value.tet_labels.assign(values.begin(), values.end());
  for (const auto& [value, size] : volumes_by_label(by_value)) volumes[value] = size;
  return volumes;
}

void check_regions(const Case& wanted, const Mesh& before, const Mesh& after) {
  for (const std::string_view name : wanted.regions) {
    CAPTURE(name);
    const auto then = volumes_by_value(before, name);
    const auto now = volumes_by_value(after, name);
    CHECK(then.size() > 1);
    REQUIRE(now.size() == then.size());
    for (const auto& [value, size] : then) CHECK(now.at(value) == doctest::Approx(size));
  }
}

void check_written(const Case& wanted, const std::filesystem::path& out) {
  const std::string text = read_text(out);
  for (const std::string_view part : wanted.written) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
  const bool has_it =
      !wanted.not_written.empty() && text.find(wanted.not_written) != std::string::npos;
  CHECK(!has_it);
}

void check_refused(const Case& wanted, Mesh& mesh) {
  check_notes(wanted, mesh.notes());
  std::string reason;
  try {
    improve(mesh);
  } catch (const Error& error) {
    reason = error.what();
  }
  CAPTURE(reason);
  CHECK(reason.find(wanted.refused) != std::string::npos);
}

}  // namespace

TEST_CASE("each input that people have is improved as its row says, and checked against itself") {
  const TempFolder folder;
  for (const Case& wanted : cases()) {
    CAPTURE(wanted.file);
    CAPTURE(wanted.kind);
    const std::filesystem::path file = kFolder / wanted.file;
    const Mesh before = load(file);
    check_as_read(wanted, before);
    Mesh mesh = before;
    if (!wanted.refused.empty()) {
      check_refused(wanted, mesh);
      continue;
    }
    const Result result = improve(mesh, {.purpose = "angles"});
    check_run(wanted, result);
    std::vector<std::string> notes = before.notes();
    notes.insert(notes.end(), result.notes.begin(), result.notes.end());
    check_notes(wanted, notes);
    check_values(wanted, mesh);
    const std::filesystem::path out = folder / file.filename().string();
    save(out, mesh);
    const Mesh again = load(out);
    check_identifiers(wanted, before, again, result);
    check_regions(wanted, before, again);
    check_written(wanted, out);
    for (const Fact& fact : compare(before, again)) {
      CAPTURE(fact.text);
      CHECK(fact.holds);
    }
  }
}

TEST_CASE("each file of the cases has a row, and each row a file") {
  std::set<std::string> rows;
  for (const Case& row : cases()) CHECK(rows.insert(std::string(row.file)).second);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::filesystem::path extension = entry.path().extension();
    // The geometries need Gmsh: tests/oracle/geometry_cases_test.py has their rows.
    if (extension == ".py" || extension == ".node" || extension == ".geo") continue;
    CAPTURE(entry.path().string());
    CHECK(rows.erase(entry.path().filename().string()) == 1);
  }
  CHECK(rows.empty());
}
