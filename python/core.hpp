// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <chrono>
#include <stdexcept>

namespace catena::python {

/// A failed computation; the message is that of the program.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether a long computation, which runs without the interpreter's lock, may continue. After
/// Ctrl-C the answer is no, and rethrow() raises KeyboardInterrupt.
class SignalCheck {
 public:
  bool operator()();
  /// Call it with the lock; does nothing unless Ctrl-C was pressed.
  void rethrow() const;

 private:
  std::chrono::steady_clock::time_point next_{};
  bool raised_ = false;
};

/// Marks the array as read-only for Python and returns it.
pybind11::array read_only(pybind11::array array);

/// A view of a matrix with one column per time as an array with one row per time; `owner` keeps the
/// memory alive.
pybind11::array rows_per_time(const Eigen::MatrixXd& matrix, pybind11::handle owner);

/// Cases and identify (cases.cpp).
void add_cases(pybind11::module_& module);
/// diagnose (diagnoses.cpp).
void add_diagnoses(pybind11::module_& module);

}  // namespace catena::python
