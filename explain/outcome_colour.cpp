// SPDX-License-Identifier: MIT
#include "explain/outcome_colour.h"

namespace tetmend::explain {

figure::Colour outcome_colour(Outcome outcome) {
  switch (outcome) {
    case Outcome::unfinished:
      return {240, 190, 40, 255};
    case Outcome::accepted:
      return {46, 150, 84, 255};
    case Outcome::no_improvement:
      return {128, 136, 148, 255};
    case Outcome::limit:
      return {150, 90, 190, 255};
    case Outcome::constrained:
      return {60, 120, 200, 255};
    case Outcome::rejected:
      return {205, 110, 60, 255};
    case Outcome::other:
      return {160, 160, 120, 255};
  }
  return {};
}

}  // namespace tetmend::explain
