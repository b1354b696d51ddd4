// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/program.hpp"

#include <iterator>
#include <stdexcept>

namespace catena {

namespace {

// std::visit with one lambda for each kind.
template <class... Cases>
struct Kinds : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Kinds(Cases...) -> Kinds<Cases...>;

// Visits every place and every other affine integer of a tree.
template <class OnPlace, class OnAffine>
class Walk {
 public:
  Walk(const OnPlace& on_place, const OnAffine& on_affine)
      : on_place_(on_place), on_affine_(on_affine) {}

  void operator()(Statements& statements) const {
    for (Statement& statement : statements) std::visit(*this, statement);
  }
  void operator()(Input& input) const { on_affine_(input.place); }
  void operator()(Variable& variable) const {
    if (variable.entries) on_affine_(*variable.entries);
  }
  void operator()(NamedValue& named) const { (*this)(named.value); }
  void operator()(Assignment& assignment) const {
    if (assignment.place) on_place_(*assignment.place);
    (*this)(assignment.value);
  }
  void operator()(Loop& loop) const {
    on_affine_(loop.first);
    on_affine_(loop.last);
    (*this)(loop.body);
  }
  void operator()(Block& block) const { (*this)(block.body); }
  void operator()(Sum& sum) const {
    for (Product& product : sum) {
      for (auto* factors : {&product.above, &product.below})
        for (Factor& factor : *factors) std::visit(*this, factor.value);
    }
  }
  void operator()(Number&) const {}
  void operator()(Read& read) const {
    if (read.place) on_place_(*read.place);
  }
  void operator()(Call& call) const { (*this)(call.argument); }

 private:
  const OnPlace& on_place_;
  const OnAffine& on_affine_;
};

void add(OperationCount& count, const Sum& sum);

void add(OperationCount& count, const std::vector<Factor>& factors) {
  count.multiplications += static_cast<long>(factors.size()) - 1;
  for (const Factor& factor : factors) {
    if (const auto* sum = std::get_if<Sum>(&factor.value)) add(count, *sum);
    if (std::holds_alternative<Call>(factor.value)) count.functions += 1;
  }
}

void add(OperationCount& count, const Sum& sum) {
  if (sum.size() > 1) count.additions += static_cast<long>(sum.size()) - 1;
  for (const Product& product : sum) {
    add(count, product.above);
    if (product.below.empty()) continue;
    add(count, product.below);
    count.divisions += 1;
  }
}

void add(OperationCount& count, const OperationCount& body, const Affine& times) {
  for (const auto member : {&OperationCount::additions, &OperationCount::multiplications,
                            &OperationCount::divisions, &OperationCount::functions}) {
    const Affine& each = body.*member;
    if (each.slope != 0 && times.slope != 0)
      throw std::logic_error("operations that are not affine in the number of links");
    count.*member += Affine(each.constant * times.constant,
                            each.constant * times.slope + each.slope * times.constant);
  }
}

}  // namespace

Affine& Affine::operator+=(const Affine& other) {
  constant += other.constant;
  slope += other.slope;
  return *this;
}

bool Factor::operator==(const Factor& other) const { return value == other.value; }
bool Block::operator==(const Block& other) const {
  return body == other.body && unless_zero == other.unless_zero;
}
bool Loop::operator==(const Loop& other) const {
  return first == other.first && last == other.last && step == other.step && body == other.body;
}

OperationCount operations_of(const Statements& statements) {
  OperationCount count;
  for (const Statement& statement : statements) {
    std::visit(Kinds{[&](const NamedValue& named) { add(count, named.value); },
                     [&](const Assignment& assignment) { add(count, assignment.value); },
                     [&](const Block& block) { add(count, operations_of(block.body), 1); },
                     [&](const Loop& loop) {
                       Affine steps(loop.step * (loop.last.constant - loop.first.constant) + 1,
                                    loop.step * (loop.last.slope - loop.first.slope));
                       add(count, operations_of(loop.body), steps);
                     },
                     [](const Input&) {}, [](const Variable&) {}},
               statement);
  }
  return count;
}

void for_each_affine(Statements& statements, const std::function<void(Affine&)>& visit) {
  const auto on_place = [&](ArrayPlace& place) {
    visit(place.base);
    visit(place.at);
  };
  Walk(on_place, visit)(statements);
}

Statements at_links(Statements statements, long links) {
  for_each_affine(statements, [&](Affine& affine) { affine = affine.at(links); });
  return statements;
}

Statements at_step(Statements statements, long i) {
  const auto on_place = [&](ArrayPlace& place) {
    if (place.of_link) place.at += i;
    place.of_link = false;
  };
  const auto on_affine = [](Affine&) {};
  Walk(on_place, on_affine)(statements);
  return statements;
}

Statements written_out(const Statements& statements) {
  Statements out;
  const auto append = [&](Statements more) {
    out.insert(out.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
  };
  for (const Statement& statement : statements) {
    if (const auto* block = std::get_if<Block>(&statement)) {
      append(written_out(block->body));
    } else if (const auto* loop = std::get_if<Loop>(&statement)) {
      const long step = loop->step, last = loop->last.constant;
      for (long i = loop->first.constant; step > 0 ? i <= last : i >= last; i += step)
        append(at_step(written_out(loop->body), i));
    } else {
      out.push_back(statement);
    }
  }
  return out;
}

}  // namespace catena
