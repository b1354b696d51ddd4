// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <chrono>
#include <stdexcept>

namespace catena::python {

/// A computation failed; the message is the program's.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Asked often by a long computation without the interpreter's lock: whether to go on. After a
/// Ctrl-C the answer stays no, and rethrow() raises KeyboardInterrupt.
class SignalCheck {
 public:
  bool operator()();
  void rethrow() const;

 private:
  std::chrono::steady_clock::time_point next_{};
  bool raised_ = false;
};

/// The array, which Python may then not write to.
pybind11::array read_only(pybind11::array array);

/// A view of a matrix with one column per time as an array with one row per time; `owner` keeps the
/// memory alive.
pybind11::array rows_per_time(const Eigen::MatrixXd& matrix, pybind11::handle owner);

/// Cases and identify (studies.cpp).
void add_studies(pybind11::module_& module);
/// diagnose (diagnoses.cpp).
void add_diagnoses(pybind11::module_& module);

}  // namespace catena::python
