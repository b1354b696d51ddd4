// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/input_error.hpp"
#include "generator/derivation/tangent_equations.hpp"
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// Entry r of row a of what a matrix keeps for each link is in array a * columns + r. Blocks of one entry
// have no arrays of `diagonal`, `below` and `above`. `lower_triangle`: of a symmetric block.
void add_entries(std::vector<Output>& outputs, const std::string& array,
                 const Quasiseparable::Entries& entries, bool numbered,
                 bool lower_triangle = false) {
  for (size_t i = 1; i + 1 < entries.size(); ++i) {
    int number = 0;
    for (size_t a = 0; a < entries[i].size(); ++a) {
      const size_t columns = lower_triangle ? a + 1 : entries[i][a].size();
      for (size_t r = 0; r < columns; ++r, ++number) {
        outputs.push_back({{"matrix", array, numbered ? std::optional(number) : std::nullopt},
                           static_cast<int>(i),
                           ArrayPlace{{}, true, -1},
                           entries[i][a][r]});
      }
    }
  }
}

std::vector<Output> all_entries(const Quasiseparable& q, bool symmetric) {
  std::vector<Output> outputs;
  const bool blocks = q.block > 1 || q.border > 0;
  for (size_t k = 0, number = 0; k < q.corner.size(); ++k)
    for (const ex& entry : q.corner[k])
      outputs.push_back({{"matrix", "corner", {}},
                         kNoIndex,
                         ArrayPlace{{}, false, static_cast<long>(number++)},
                         entry});
  if (q.border > 0) {
    add_entries(outputs, "border_column", q.border_column, true);
    add_entries(outputs, "border_row", q.border_row, true);
  }
  if (symmetric) {
    add_entries(outputs, "row", q.lower_row, true);
    add_entries(outputs, "column", q.lower_column, true);
    add_entries(outputs, "diagonal", q.diagonal, blocks, true);
    return outputs;
  }
  add_entries(outputs, "upper_row", q.upper_row, true);
  add_entries(outputs, "upper_column", q.upper_column, true);
  add_entries(outputs, "lower_row", q.lower_row, true);
  add_entries(outputs, "lower_column", q.lower_column, true);
  add_entries(outputs, "diagonal", q.diagonal, blocks);
  add_entries(outputs, "below", q.below, blocks);
  add_entries(outputs, "above", q.above, blocks);
  return outputs;
}

bool any_nonzero(const Quasiseparable::Entries& entries) {
  for (const auto& rows : entries)
    for (const auto& row : rows)
      for (const ex& entry : row)
        if (!entry.is_zero()) return true;
  return false;
}

}  // namespace

void FunctionBuilder::mass_and_acceleration() {
  result_.accelerations = "acceleration";
  ModelSummary& s = result_.summary;
  Substitution bias = without_acceleration(chain_);
  const auto h = each(chain_.residual(), [&](const ex& e) { return bias.of(e); });
  add_of_all("bias", "r with a = 0.", {at(), result("h")}, body(from_coordinates("h", h), at_));

  const TangentEquations tangents =
      in_space() ? find_tangent_equations(chain_, "mass_") : TangentEquations();
  const bool by_tangents = tangents.mass.found;
  const Quasiseparable mass =
      by_tangents ? tangents.mass : find_structure(chain_, {1, 0, 0}, "mass_");
  s.mass_structured = mass.found;
  s.why_not = mass.reason;
  if (!mass.found && s.constraints > 0)
    throw InputError(
        "a chain whose far end is held needs a mass matrix of the form of the plain chain's: " +
        mass.reason);
  const std::string acceleration_comment =
      "a such that r = 0. Returns 0, or the 1-based coordinate whose pivot is not positive.";
  if (!mass.found) {
    Differential along_a(definitions_,
                         [](const std::string& family) { return family + "_inertial"; });
    for (const ex& a : chain_.accelerations()) along_a.set(a, a);
    const auto inertial = each(chain_.residual(), [&](const ex& e) { return along_a.of(e); });
    add_inner("inertial", "M a, of the chain and of every effect.", {at(), result("r")},
              body(from_coordinates("r", inertial), at_));
    add_of_all("mass_matrix", "M, row by row: its columns are M a for unit accelerations.",
               {at(), result("M")}, {}, Frame::kMassColumns);
    add("acceleration", acceleration_comment, {at(), result("a")}, {}, Frame::kDenseAcceleration);
    return;
  }
  // A border needs factors with which to solve more than once.
  const bool symmetric = by_tangents || (mass.symmetric && mass.block == 1 && mass.border == 0 &&
                                         !any_nonzero(mass.below) && !any_nonzero(mass.above));
  s.mass_symmetric = mass.symmetric;
  s.mass_rank = mass.lower_rank;
  s.block = static_cast<int>(chain_.axes().size() == 2 ? 1 : 3);
  result_.mass = {symmetric ? MatrixForm::kSymmetricSemiseparable : MatrixForm::kQuasiseparable,
                  mass.upper_rank,
                  mass.lower_rank,
                  mass.block,
                  mass.border,
                  tangents.isotropic};
  std::vector<Output> all;
  if (tangents.isotropic) {
    add_entries(all, "row", tangents.number_of_row, true);
    add_entries(all, "column", tangents.number_of_column, true);
    add_entries(all, "diagonal", tangents.number_of_diagonal, true);
  } else {
    all = all_entries(mass, symmetric);
  }
  if (by_tangents) {
    add_entries(all, "tangent", tangents.tangent, true);
    add_entries(all, "size", tangents.size, false);
  }
  std::vector<Output> entries = all;
  if (by_tangents) add_entries(entries, "along", tangents.along, false);
  add_of_all("mass_matrix", "M, row by row.", {at(), result("M")}, body(entries, at_),
             Frame::kMassMatrix);
  if (by_tangents) {
    const auto add_components = [&](const Array& array, int sign,
                                    const Quasiseparable::Entries& values) {
      for (int i = 1; i <= links_; ++i) {
        const auto& rows = values[static_cast<size_t>(i)];
        for (size_t a = 0; a < rows.size(); ++a)
          all.push_back(
              {array, i, ArrayPlace{static_cast<long>(a) * links_, true, -1}, sign * rows[a][0]});
      }
    };
    add_components({"matrix", "right", {}}, -1, tangents.force);
    add_components({"", "a", {}}, 1, tangents.acceleration);
  } else {
    for (const Output& output : from_coordinates("a", each(h, [](const ex& e) { return ex(-e); })))
      all.push_back(output);
  }
  add("acceleration", acceleration_comment, {at(), result("a")}, body(all, at_),
      Frame::kAcceleration);
  if (layout_ != Layout::kLoops || !has_all()) return;
  result_.accelerations = "accelerations";
  add_inner("accelerations",
            "The same, bit for bit, in the order that suits a T of several numbers.",
            {at(), result("a")}, function_body(definitions_, all, at_, Layout::kWholeSweeps),
            Frame::kAcceleration);
}

void FunctionBuilder::newton() {
  ModelSummary& s = result_.summary;
  const Weights weights{definitions_.input("ca"), definitions_.input("cv"),
                        definitions_.input("cq")};
  const Quasiseparable newton = find_structure(chain_, weights, "newton_");
  s.structured = newton.found;
  if (!newton.found) {
    s.why_not = newton.reason;
    return;
  }
  s.newton_upper_rank = newton.upper_rank;
  s.newton_lower_rank = newton.lower_rank;
  result_.newton = {MatrixForm::kQuasiseparable, newton.upper_rank, newton.lower_rank, newton.block,
                    newton.border};
  add_inner("newton_matrix", "ca dr/da + cv dr/dv + cq dr/dq at the point (at.a is read).",
            {at(), number("ca"), number("cv"), number("cq"), {ParameterKind::kMatrix, "matrix"}},
            body(all_entries(newton, false), at_));
}

}  // namespace catena
