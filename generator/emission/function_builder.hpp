// SPDX-License-Identifier: GPL-3.0-or-later
//
// Builds the functions of one model, each kind in a file of its own: the equations of motion
// (equation_functions.cpp), matrices and what is solved with them (matrix_functions.cpp), what a
// user reads off a state (output_functions.cpp).
#pragma once

#include <string>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/emission/function_body.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/parameter_table.hpp"

namespace catena {

class FunctionBuilder {
 public:
  FunctionBuilder(const Description& description, int links, Layout layout, FunctionSet set);

  /// All of them; to be called once.
  ModelFunctions build();

 private:
  // equation_functions.cpp
  void residual();
  void terms();
  void state_rates();
  void adjoint();

  // matrix_functions.cpp
  void mass_and_acceleration();
  void newton();

  // output_functions.cpp
  void energy();
  void positions();
  void internal_forces();
  void reactions();
  void gap();
  void events();
  void sensor();

  // what they share
  bool in_space() const { return description_.space == Space::kThreeDimensional; }
  bool has_all() const { return result_.set == FunctionSet::kAll; }
  void set_tangent_directions();
  std::vector<Output> tangents_of(std::vector<Output> outputs);
  Substitution without_acceleration(Chain& chain);
  Statements body(const std::vector<Output>& outputs, const Inputs& inputs) {
    return function_body(definitions_, outputs, inputs, layout_, switches_);
  }

  void add(const std::string& name, const std::string& comment, std::vector<Parameter> parameters,
           Statements statements, Frame frame = Frame::kStatements) {
    result_.functions.push_back(
        {name, comment, std::move(parameters), std::move(statements), frame, true});
  }
  /// One that only the table of all functions has.
  void add_of_all(const std::string& name, const std::string& comment,
                  std::vector<Parameter> parameters, Statements statements,
                  Frame frame = Frame::kStatements) {
    add(name, comment, std::move(parameters), std::move(statements), frame);
    result_.functions.back().in_table = has_all();
  }
  /// One that the table does not have.
  void add_inner(const std::string& name, const std::string& comment,
                 std::vector<Parameter> parameters, Statements statements,
                 Frame frame = Frame::kStatements) {
    add(name, comment, std::move(parameters), std::move(statements), frame);
    result_.functions.back().in_table = false;
  }

  // parameters
  static Parameter at() { return {ParameterKind::kPoint, "at"}; }
  static Parameter along() { return {ParameterKind::kPoint, "along", Type::kDifferential}; }
  static Parameter result(const std::string& name) { return {ParameterKind::kResults, name}; }
  static Parameter change(const std::string& name) {
    return {ParameterKind::kResults, name, Type::kDifferential};
  }
  static Parameter numbers(const std::string& name) { return {ParameterKind::kNumbers, name}; }
  static Parameter number(const std::string& name) { return {ParameterKind::kNumber, name}; }
  static Parameter maybe_unused(Parameter parameter) {
    parameter.maybe_unused = true;
    return parameter;
  }

  std::vector<GiNaC::ex> each(const std::vector<GiNaC::ex>& values, const auto& act) {
    std::vector<GiNaC::ex> out;
    for (const GiNaC::ex& value : values) out.push_back(act(value));
    return out;
  }

  static std::vector<Output> from_one(const std::string& array,
                                      const std::vector<GiNaC::ex>& values) {
    std::vector<Output> outputs;
    for (size_t i = 0; i < values.size(); ++i) {
      outputs.push_back(
          {{"", array, {}}, static_cast<int>(i) + 1, ArrayPlace{{}, true, -1}, values[i]});
    }
    return outputs;
  }

  /// Of values that belong to the coordinates, in their order: a part of the array for each family.
  std::vector<Output> from_coordinates(const std::string& array,
                                       const std::vector<GiNaC::ex>& values) const {
    std::vector<Output> outputs;
    const int of_links = static_cast<int>(values.size()) - chain_.border();
    for (int i = 0; i < static_cast<int>(values.size()); ++i) {
      const int link = i % links_ + 1;
      const long family = i / links_;
      const bool of_link = i < of_links;
      outputs.push_back({{"", array, {}},
                         of_link ? link : kNoIndex,
                         of_link ? ArrayPlace{family * links_, true, -1} : ArrayPlace{{}, false, i},
                         values[static_cast<size_t>(i)]});
    }
    return outputs;
  }

  const Description& description_;
  int links_;
  Layout layout_;
  Chain chain_;
  Definitions& definitions_;
  Differential tangent_;
  Inputs at_, at_and_along_;
  std::vector<Switch> switches_;  ///< of the effects
  ModelFunctions result_;
};

}  // namespace catena
