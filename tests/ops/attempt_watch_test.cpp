// SPDX-License-Identifier: MIT
#include "ops/attempt_watch.h"

#include <functional>
#include <thread>
#include <utility>

#include <doctest/doctest.h>

#include "ops/registry.h"
#include "tests/support/lone_worker.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;
using tetmend::contract::one_tet;

namespace {

struct Nothing {};
std::function<void(OperatorContext&)> asked;  // what the operator below does

/// Asks, and refuses.
struct Asking final : OperatorOf<Nothing> {
  Asking() : OperatorOf(kInfo) {}
  Verdict precondition(const OperatorContext&, Target, Nothing&) const override {
    return Verdict::accepted;
  }
  Verdict evaluate(OperatorContext& context, Target, Nothing&) const override {
    asked(context);
    return Verdict::no_improvement;
  }
  Verdict apply(OperatorContext&, Target, Transaction&, Nothing&) const override {
    return Verdict::no_improvement;
  }
  static std::unique_ptr<Operator> make(const ParameterValues&) {
    return std::make_unique<Asking>();
  }
  inline static const OperatorInfo kInfo = {"asking", TargetKind::vertex, "help", {}, make};
};

std::unique_ptr<Operator> make_asking(std::string_view origin) {
  Registry registry;
  registry.add(Asking::kInfo, origin);
  return registry.make("asking");
}

}  // namespace

TEST_CASE("an attempt of a plugin is seen by all threads until it has come back") {
  const auto op = make_asking("their.so");
  LoneWorker worker(one_tet());
  std::vector<PendingAttempt> seen;
  bool was_own = false;
  asked = [&](OperatorContext&) {
    std::thread([&] {
      seen = pending_attempts();
      was_own = own_pending_attempt() != nullptr;
    }).join();
    REQUIRE(own_pending_attempt() != nullptr);
    CHECK(&own_pending_attempt()->op() == op.get());
    CHECK(own_pending_attempt()->target().code == 2);
  };
  const auto before = std::chrono::steady_clock::now();
  worker.attempt(*op, Target::of(VertexHandle(2)));
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].what == "operator 'asking' of their.so at vertex 2");
  CHECK(seen[0].since >= before);
  CHECK_FALSE(was_own);
  CHECK(pending_attempts().empty());
  CHECK(own_pending_attempt() == nullptr);
}

TEST_CASE("an attempt that ends by an exception is pending no longer") {
  LoneWorker worker(one_tet());
  asked = [&](OperatorContext&) { throw Error("no"); };
  CHECK_THROWS_AS(worker.attempt(*make_asking("their.so"), Target::of(VertexHandle(2))), Error);
  CHECK(pending_attempts().empty());
  CHECK(own_pending_attempt() == nullptr);
}

TEST_CASE("of an attempt in another one the outer is seen, also when the inner has come back") {
  const auto outer = make_asking("outer.so");
  const auto inner = make_asking("inner.so");
  LoneWorker worker(one_tet());
  std::vector<std::string> seen;
  const auto look = [&](OperatorContext&) {
    for (const PendingAttempt& attempt : pending_attempts()) seen.push_back(attempt.what);
  };
  bool is_inner = false;
  asked = [&](OperatorContext& context) {
    if (std::exchange(is_inner, true)) return look(context);
    inner->attempt(context, Target::of(VertexHandle(3)));
    look(context);
  };
  worker.attempt(*outer, Target::of(VertexHandle(2)));
  CHECK(seen == std::vector<std::string>(2, "operator 'asking' of outer.so at vertex 2"));
}

TEST_CASE("an attempt of tetmend itself is not looked after") {
  LoneWorker worker(one_tet());
  bool was_seen = true;
  asked = [&](OperatorContext&) {
    was_seen = !pending_attempts().empty() || own_pending_attempt() != nullptr;
  };
  worker.attempt(*make_asking(""), Target::of(VertexHandle(2)));
  CHECK_FALSE(was_seen);
}
