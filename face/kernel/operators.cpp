// SPDX-License-Identifier: MIT
// Makes an operator ready, lets it try, and writes down its tree of calls.
#include "face/kernel/operators.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/catalogue.h>

#include "face/kernel/operator_tools.h"
#include "face/kernel/transaction.h"
#include "kernel/workspace.h"
#include "trace/recorder.h"

namespace tetmend::kernel {

namespace {

/// Attempts as a tree.
class CallTree final : public TraceSink {
 public:
  explicit CallTree(TraceSink* observer) : observer_(observer) {}

  void attempt_begins(const AttemptEvent& event) override {
    if (observer_ != nullptr) observer_->attempt_begins(event);
    Call call;
    call.operator_name = event.operator_name;
    call.target.assign(event.target.begin(), event.target.end());
    call.level = event.level;
    open_.push_back(std::move(call));
  }
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override {
    if (observer_ != nullptr) observer_->attempt_ends(verdict, before, now);
    Call call = std::move(open_.back());
    open_.pop_back();
    call.verdict = verdict;
    if (!before.empty()) call.worst_before = static_cast<double>(before.front());
    if (!now.empty()) call.worst_after = static_cast<double>(now.front());
    if (open_.empty()) {
      root = std::move(call);
    } else {
      open_.back().children.push_back(std::move(call));
    }
  }
  void candidate_found() override {
    if (observer_ != nullptr) observer_->candidate_found();
  }
  void edit_made(const tetmend::TetMesh& mesh, const Journal& journal) noexcept override {
    if (observer_ != nullptr) observer_->edit_made(mesh, journal);
    if (!open_.empty()) ++open_.back().edits;
  }
  void edit_undone() noexcept override {
    if (observer_ != nullptr) observer_->edit_undone();
  }

  Call root;

 private:
  TraceSink* observer_;
  std::vector<Call> open_;
};

void write(const Call& call, unsigned depth, std::string& text) {
  std::vector<std::uint32_t> target;
  for (const VertexHandle v : call.target) target.push_back(v.index());
  text += fmt::format("{:{}}{}({}) {}", "", 2 * depth, call.operator_name, fmt::join(target, " "),
                      to_string(call.verdict));
  if (call.worst_before != 0 || call.worst_after != 0) {
    text += fmt::format(" {:.3f} -> {:.3f}", call.worst_before, call.worst_after);
  }
  text += '\n';
  for (const Call& child : call.children) write(child, depth + 1, text);
}

}  // namespace

std::size_t Call::size() const {
  std::size_t count = 1;
  for (const Call& child : children) count += child.size();
  return count;
}

std::string Call::text() const {
  std::string text;
  write(*this, 0, text);
  return text;
}

OperatorTools& OperatorTools::of(TetMesh& mesh) {
  if (!mesh.tools_) {
    mesh.tools_ = {new OperatorTools, [](OperatorTools* tools) { delete tools; }};
  }
  return *mesh.tools_;
}

const Operator& OperatorTools::find(std::string_view name) {
  const auto found = operators.find(name);
  if (found != operators.end()) return *found->second;
  return *operators.emplace(name, registry.make(name)).first->second;
}

TetHandle OperatorTools::tet_of(Target target) {
  switch (target.kind) {
    case TargetKind::tet:
      return target.tet();
    case TargetKind::edge:
      return target.edge().tet();
    case TargetKind::face:
      return target.face().tet();
    case TargetKind::vertex:
      break;
  }
  return {};
}

bool OperatorTools::is_live(const TetMesh& mesh, Target target) {
  if (target.kind == TargetKind::vertex) {
    return mesh.is_known(target.vertex(), "attempt") &&
           mesh.mesh_.tet_of(target.vertex()).is_valid();
  }
  if (target.kind == TargetKind::face && target.face().is_outside()) return false;
  const TetHandle t = tet_of(target);
  return mesh.is_known(t, "attempt") && !mesh.mesh_.is_deleted(t);
}

void OperatorTools::check_target(std::string_view name, TargetKind kind, Target target) {
  if (kind == target.kind) return;
  throw Error(fmt::format("attempt: operator '{}' is for a target of kind {}, not {}", name,
                          to_string(kind), to_string(target.kind)));
}

Call OperatorTools::attempt(TetMesh& mesh, const Operator& op, Target target, bool keeps,
                            TraceSink* observer) {
  PropertyKeeper& keeper = *mesh.keeper_;
  CallTree tree(observer);
  keeper.start();
  Transaction scope(mesh);
  {
    struct Listening {  // ends before the scope does
      TetMesh& mesh;
      ~Listening() {
        mesh.keeper_->set_next(nullptr);
        mesh.listen();
      }
    } listening{mesh};
    keeper.set_next(&tree);
    if (!keeper.is_needed()) mesh.workspace_->set_listener(&tree);
    OperatorContext context{mesh.mesh_, *mesh.workspace_, states};
    context.trace = &tree;
    op.attempt(context, target);
  }
  Call call = std::move(tree.root);
  if (keeper.has_failed()) {
    scope.undo();
    keeper.rethrow();
  }
  if (keeper.take_touched_lock() && call.accepted()) {
    scope.undo();
    call.verdict = Verdict::constrained;
  }
  if (keeps && call.accepted()) scope.keep();
  return call;
}

Call OperatorTools::attempt_at(TetMesh& mesh, std::string_view operator_name, Target target,
                               const ParameterSettings& settings, bool keeps, TraceSink* observer) {
  OperatorTools& tools = OperatorTools::of(mesh);
  std::unique_ptr<Operator> own;
  if (!settings.empty()) own = tools.registry.make(operator_name, settings);
  const Operator& op = own ? *own : tools.find(operator_name);
  const OperatorInfo& info = op.info();
  OperatorTools::check_target(info.name, info.target, target);
  Call call;
  call.operator_name = info.name;
  if (!OperatorTools::is_live(mesh, target)) return call;
  if (target.kind == TargetKind::vertex && mesh.is_fixed(target.vertex())) {
    call.target = {target.vertex()};
    call.verdict = Verdict::constrained;
    return call;
  }
  return tools.attempt(mesh, op, target, keeps, observer);
}

std::string OperatorTools::trace_of_attempt(TetMesh& mesh, std::string_view operator_name,
                                            Target target, const ParameterSettings& settings) {
  mesh.check_closed("trace_of_attempt()");
  TraceHeader header;
  header.program = fmt::format("tetmend {}", version());
  header.schedule = "an attempt";
  std::string bytes;
  TraceRecorder recorder(bytes, mesh.mesh_, std::move(header));
  attempt_at(mesh, operator_name, target, settings, false, &recorder);
  recorder.finish();
  return bytes;
}

Call attempt_at(TetMesh& mesh, std::string_view operator_name, Target target,
                const ParameterSettings& settings, bool keeps) {
  return OperatorTools::attempt_at(mesh, operator_name, target, settings, keeps);
}

std::string trace_of_attempt(TetMesh& mesh, std::string_view operator_name, Target target,
                             const ParameterSettings& settings) {
  return OperatorTools::trace_of_attempt(mesh, operator_name, target, settings);
}

}  // namespace tetmend::kernel
