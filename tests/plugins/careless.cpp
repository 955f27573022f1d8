// SPDX-License-Identifier: MIT
// A 3-2 flip that asks nobody where its territory ends.
#include <memory>

#include <tetmend/plugin.h>

namespace tetmend::test {
namespace {

struct Flip {
  Shell shell;
  Replacement tets;
};

class Careless final : public OperatorOf<Flip> {
 public:
  explicit Careless(const ParameterValues&) : OperatorOf(kInfo) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target, Flip& flip) const override {
    const ShellKind kind = find_shell(context.mesh, target.edge(), flip.shell, Territory());
    const bool is_right = kind == ShellKind::closed && flip.shell.degree == 3;
    return is_right ? Verdict::accepted : Verdict::not_applicable;
  }
  Verdict evaluate(OperatorContext&, Target, Flip& flip) const override {
    const Shell& shell = flip.shell;
    const auto& ring = shell.ring;
    flip.tets.old_tets.assign(shell.tets.begin(), shell.tets.begin() + 3);
    flip.tets.new_tets = {{shell.a, ring[0], ring[1], ring[2]},
                          {ring[0], ring[1], ring[2], shell.b}};
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction, Flip& flip) const override {
    return flip.tets.make(transaction);
  }

 public:
  inline static const OperatorInfo kInfo = {
      "careless",
      TargetKind::edge,
      "help",
      {},
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<Careless>(values);
      }};
};

}  // namespace
}  // namespace tetmend::test

TETMEND_PLUGIN(registry) {
  registry.add(tetmend::test::Careless::kInfo);
}
