// SPDX-License-Identifier: MIT
// Which fields of the cards of Nastran's bulk data are numbers of points.
//
// Fields count from behind the name, and a line has eight: field 8 is the first of the second line.
// Who knows a card that is not here takes its row from the Quick Reference Guide. An unknown card
// must not lose a point: all of its integers count.
#include "kernel/formats/nastran_references.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>

#include "kernel/formats/field_pattern.h"

namespace tetmend::formats {
namespace {

struct CardRow {
  std::string_view name;
  std::string_view pattern;
};

constexpr std::array kWithPoints = std::to_array<CardRow>({
    // loads, displacements, temperatures
    {"FORCE", "-p"},
    {"FORCE1", "-p-pp"},
    {"FORCE2", "-p-pppp"},
    {"MOMENT", "-p"},
    {"MOMENT1", "-p-pp"},
    {"MOMENT2", "-p-pppp"},
    {"SLOAD", "-(p-)"},
    {"PLOAD", "--pppp"},
    {"PLOAD4", "------pp"},
    {"PLOADX1", "----pp"},
    {"RFORCE", "-p"},
    {"ACCEL1", "--------(p)"},
    {"DAREA", "-(p--)"},
    {"DELAY", "-(p--)"},
    {"DPHASE", "-(p--)"},
    {"TIC", "-p"},
    {"TEMP", "-p-p-p"},
    {"TEMPBC", "---p-p-p"},
    {"QHBDY", "----(p)"},
    {"QVOL", "--p"},
    {"CONV", "---(p)"},
    {"CONVM", "--pppp"},
    {"RADBC", "p-p"},
    {"NOLIN1", "-p--p"},
    {"NOLIN2", "-p--p-p"},
    {"NOLIN3", "-p--p"},
    {"NOLIN4", "-p--p"},
    {"UNBALNC", "--p"},
    // constraints and sets of degrees of freedom
    {"SPC", "-p--p"},
    {"SPC1", "--(p)"},
    {"SPCD", "-p--p"},
    {"SPCOFF", "(p-)"},
    {"SPCOFF1", "-(p)"},
    {"SPCAX", "-p"},
    {"MPC", "(-p--p---)"},
    {"MPCD", "(-p--p---)"},
    {"SUPORT", "(p-)"},
    {"SUPORT1", "-(p-)"},
    {"ASET", "(p-)"},
    {"ASET1", "-(p)"},
    {"BSET", "(p-)"},
    {"BSET1", "-(p)"},
    {"BNDFIX", "(p-)"},
    {"BNDFIX1", "-(p)"},
    {"BNDFREE", "(p-)"},
    {"BNDFREE1", "-(p)"},
    {"BNDGRID", "-(p)"},
    {"CSET", "(p-)"},
    {"CSET1", "-(p)"},
    {"OMIT", "(p-)"},
    {"OMIT1", "-(p)"},
    {"QSET", "(p-)"},
    {"QSET1", "-(p)"},
    {"USET", "-(p-)"},
    {"USET1", "--(p)"},
    {"SEBSET", "-(p-)"},
    {"SEBSET1", "--(p)"},
    {"SECSET", "-(p-)"},
    {"SECSET1", "--(p)"},
    {"SEQSET", "-(p-)"},
    {"SEQSET1", "--(p)"},
    {"SESUP", "-(p-)"},
    {"SEUSET", "--(p-)"},
    {"SEUSET1", "---(p)"},
    {"SESET", "-(p)"},
    {"SEEXCLD", "--(p)"},
    {"SECONCT", "--------(p)"},
    {"SELOC", "-pppppp"},
    {"RELEASE", "--(p)"},
    {"EXTRN", "(p-)"},
    {"CSUPER", "--(p)"},
    {"CSUPEXT", "-(p)"},
    {"CYJOIN", "--(p)"},
    // rigid elements
    {"RBAR", "-pp"},
    {"RBAR1", "-pp"},
    {"RROD", "-pp"},
    {"RJOINT", "-pp"},
    {"RBE1", "(-p-p-p--)"},
    {"RBE2", "-p-(p)"},
    {"RTRPLT", "-ppp"},
    {"RTRPLT1", "-ppp"},
    {"RSPLINE", "--p(p-)"},
    {"RSPINR", "-ppp"},
    {"RSPINT", "-ppp"},
    {"ROTORG", "-(p)"},
    // elements
    {"CBAR", "--ppp"},
    {"CBEAM", "--ppp-----------pp"},
    {"CBEAM3", "--pppp"},
    {"CBEND", "--ppp"},
    {"CBUSH", "--ppp"},
    {"CBUSH1D", "--pp"},
    {"CBUSH2D", "--pp"},
    {"CROD", "--pp"},
    {"CONROD", "-pp"},
    {"CTUBE", "--pp"},
    {"CVISC", "--pp"},
    {"CGAP", "--ppp"},
    {"CELAS1", "--p-p"},
    {"CELAS2", "--p-p"},
    {"CELAS3", "--pp"},
    {"CELAS4", "--pp"},
    {"CDAMP1", "--p-p"},
    {"CDAMP2", "--p-p"},
    {"CDAMP3", "--pp"},
    {"CDAMP4", "--pp"},
    {"CDAMP5", "--pp"},
    {"CMASS1", "--p-p"},
    {"CMASS2", "--p-p"},
    {"CMASS3", "--pp"},
    {"CMASS4", "--pp"},
    {"CONM1", "-p"},
    {"CONM2", "-p"},
    {"CFAST", "-----ppp"},
    {"CWELD", "--p-pp--(p)"},
    {"CSHEAR", "--pppp"},
    {"CTRIAR", "--ppp"},
    {"CQUADR", "--pppp"},
    {"CQUAD", "--(p)"},
    {"CTRIAX", "--(p)"},
    {"CTRIAX6", "--pppppp"},
    {"CQUADX", "--(p)"},
    {"CPLSTN3", "--ppp"},
    {"CPLSTN4", "--pppp"},
    {"CPLSTS3", "--ppp"},
    {"CPLSTS4", "--pppp"},
    {"CRAC2D", "--(p)"},
    {"CRAC3D", "--(p)"},
    {"CAABSF", "--pppp"},
    {"CHACAB", "--(p)"},
    {"CHACBR", "--(p)"},
    {"CHBDYG", "--------(p)"},
    {"CHBDYP", "-----ppp"},
    {"PLOTEL", "-pp--pp"},
    {"PLOTEL3", "-ppp"},
    {"PLOTEL4", "-pppp"},
    {"FEEDGE", "-pp"},
    {"FEFACE", "-pppp"},
    // coordinate systems, matrices, vectors, contact, optimisation
    {"CORD1R", "-ppp-ppp"},
    {"CORD1C", "-ppp-ppp"},
    {"CORD1S", "-ppp-ppp"},
    {"SNORM", "p"},
    {"TF", "-p------(p-------)"},
    {"EIGB", "---------p"},
    {"EIGC", "---p"},
    {"EIGR", "---------p"},
    {"BLSEG", "-(p)"},
    {"BOUTPUT", "-(p)"},
    {"BSURFS", "----(-ppp)"},
    {"DVGRID", "-p"},
    {"SET1", "-(p)"},  // or elements: the card does not say
});

// These begin their names: properties, materials, tables, what is of frequencies or of flows.
constexpr std::array kPointlessBeginnings = std::to_array<std::string_view>(
    {"MAT",    "TABLE",  "TABD",   "TABR",  "PAABSF", "PACABS",  "PACBAR",  "PAERO", "PBAR",
     "PBCOMP", "PBEAM",  "PBEND",  "PBUSH", "PCOMP",  "PCONEAX", "PCONV",   "PDAMP", "PELAS",
     "PFAST",  "PGAP",   "PHBDY",  "PINTC", "PLCOMP", "PLPLANE", "PLSOLID", "PMASS", "PRAC",
     "PROD",   "PSHEAR", "PSHELL", "PSHL",  "PSLDN",  "PSOLID",  "PTUBE",   "PVAL",  "PVISC",
     "PWELD",  "FREQ",   "CORD2",  "CORD3", "TSTEP",  "AE",      "CAERO",   "NSM",   "DVCREL",
     "DVMREL", "DVPREL", "DCON",   "EIGRL", "RAD",    "VIEW",    "TEMPP",   "TEMPD", "TEMPRB"});
constexpr std::array kPointless = std::to_array<std::string_view>(
    {"ACCEL",   "BAROR",   "BCBODY",  "BCONP",   "BCPARA",  "BCPROP",  "BCTABLE", "BCTADD",
     "BCTPARM", "BCTSET",  "BEAMOR",  "BFRIC",   "BGADD",   "BGPARM",  "BGSET",   "BSURF",
     "CBARAO",  "CHBDYE",  "CLOAD",   "CREEP",   "CYSYM",   "DDVAL",   "DEFORM",  "DESVAR",
     "DEQATN",  "DLINK",   "DLOAD",   "DMI",     "DMIJ",    "DOPTPRM", "DSCREEN", "DTABLE",
     "DTI",     "DVBSHAP", "DVSHAP",  "ELIST",   "EPOINT",  "FLFACT",  "FLUTTER", "GRAV",
     "GRDSET",  "GUST",    "INCLUDE", "ITER",    "LOAD",    "LOADCYH", "LOADCYN", "LSEQ",
     "MASSSET", "MDLPRM",  "MFLUID",  "MKAERO1", "MKAERO2", "MPCADD",  "NLADAPT", "NLPARM",
     "NLPCI",   "PLOAD1",  "PLOAD2",  "QBDY1",   "QBDY2",   "QBDY3",   "QBDY4",   "QVECT",
     "RANDPS",  "RANDT1",  "RLOAD1",  "RLOAD2",  "SET2",    "SPCADD",  "SPLINE1", "SPLINE2",
     "SPOINT",  "TEMPE4",  "TLOAD1",  "TLOAD2",  "TRIM"});

/// Collects what the fields of a card name.
class Collector {
 public:
  explicit Collector(const NastranCardText& card) : card_(card) {}

  NastranReferences take() { return std::move(found_); }

  void all() {
    found_.is_known = false;
    for (std::size_t i = 0; i < card_.fields.size(); ++i) look_at(i);
  }
  void by(const FieldPattern& pattern) {
    for (std::size_t i = 0; i < card_.fields.size(); ++i) {
      if (pattern.is_point(i)) look_at(i);
    }
  }

  /// EID, REFGRID, REFC; then weights, which are real, each with components and points; then,
  /// behind "UM", pairs of a point and components.
  void rbe3() {
    look_at(2);
    enum class Next { point, components, pair } next = Next::components;
    for (std::size_t i = 4; i < card_.fields.size(); ++i) {
      const std::string_view field = card_.fields[i];
      std::int64_t number = 0;
      if (field.empty()) continue;
      if (field == "UM" || field == "um") {
        next = Next::pair;
      } else if (!nastran_integer(field, number)) {
        if (double weight = 0; nastran_real(field, weight)) next = Next::components;
        if (next == Next::point) look_at(i);  // THRU
      } else if (next == Next::components) {
        next = Next::point;
      } else {
        look_at(i);
        if (next == Next::pair) ++i;
      }
    }
  }

  /// Behind "DNODE": pairs of a point and a component, up to the next word.
  void dresp2() {
    bool is_pair = false;
    for (std::size_t i = 4; i < card_.fields.size(); ++i) {
      const std::string_view field = card_.fields[i];
      std::int64_t number = 0;
      if (field.empty()) continue;
      if (!nastran_integer(field, number)) {
        is_pair = field == "DNODE" || field == "dnode";
      } else if (is_pair) {
        look_at(i++);
      }
    }
  }

 private:
  void look_at(std::size_t i) {
    std::int64_t number = 0;
    const std::string_view field = card_.field(i);
    if (field == "THRU" || field == "thru") {
      is_range_ = !found_.ranges.empty();
    } else if (field == "BY" || field == "by") {
      is_step_ = true;
    } else if (nastran_integer(field, number) && !std::exchange(is_step_, false)) {
      if (is_range_) {
        found_.ranges.back().second = number;
      } else {
        found_.ranges.emplace_back(number, number);
      }
      is_range_ = false;
    }
  }

  const NastranCardText& card_;
  NastranReferences found_;
  bool is_range_ = false;
  bool is_step_ = false;
};

template <std::size_t N>
bool lists(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_pointless(std::string_view name) {
  return lists(kPointless, name) ||
         std::any_of(kPointlessBeginnings.begin(), kPointlessBeginnings.end(),
                     [&](std::string_view beginning) { return name.starts_with(beginning); });
}

/// True if a field says that the numbers are of points.
bool is_any_case_of(std::string_view field, std::initializer_list<std::string_view> words) {
  std::string capitals(field);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return std::find(words.begin(), words.end(), capitals) != words.end();
}

/// OptiStruct's: number, type, how the members are named, which may be left out; then these.
void read_set(const NastranCardText& card, Collector& to) {
  std::int64_t number = 0;
  const bool has_type = !card.field(1).empty() && !nastran_integer(card.field(1), number);
  if (!has_type) return to.all();
  const bool is_box = is_any_case_of(card.field(2), {"BBOX"});
  if (is_any_case_of(card.field(1), {"GRID", "GRIDC"}) && !is_box) to.by(FieldPattern("--(p)"));
}

/// Cards of which other fields decide. False for others.
bool read_special(const NastranCardText& card, Collector& to) {
  const auto by = [&](std::string_view pattern) { to.by(FieldPattern(pattern)); };
  if (card.name == "RBE3") {
    to.rbe3();
  } else if (card.name == "DRESP2") {
    to.dresp2();
  } else if (card.name == "PLOAD4" && is_any_case_of(card.field(6), {"THRU"})) {
    return true;  // elements up to this number
  } else if (card.name == "PARAM") {
    if (is_any_case_of(card.field(0), {"GRDPNT"})) by("-p");
  } else if (card.name == "DMIG") {
    if (card.field(1) != "0") by("-p--(p---)");  // else it is the head of the matrix
  } else if (card.name == "SET3") {
    if (!is_any_case_of(card.field(1), {"ELEM", "PROP"})) by("--(p)");
  } else if (card.name == "SET") {
    read_set(card, to);
  } else if (card.name == "DRESP1") {
    if (is_any_case_of(card.field(2),
                       {"DISP", "VELO", "ACCL", "SPCFORCE", "GPFORCE", "FRDISP", "FRVELO", "FRACCL",
                        "FRSPCF", "TDISP", "TVELO", "TACCL", "TSPCF", "PRES"})) {
      by("-------(p)");
    }
  } else {
    return false;
  }
  return true;
}

}  // namespace

NastranReferences nastran_references(const NastranCardText& card) {
  Collector collector(card);
  if (read_special(card, collector)) return collector.take();
  const auto* row = std::find_if(kWithPoints.begin(), kWithPoints.end(),
                                 [&](const CardRow& each) { return each.name == card.name; });
  if (row != kWithPoints.end()) {
    collector.by(FieldPattern(row->pattern));
  } else if (!is_pointless(card.name)) {
    collector.all();
  }
  return collector.take();
}

bool is_nastran_set_of_elements(const NastranCardText& card) {
  const bool is_set = card.name == "SET" || card.name == "SET3";
  return is_set && is_any_case_of(card.field(1), {"ELEM", "ELEMENT"});
}

}  // namespace tetmend::formats
