// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <new>
#include <vector>

#include "runtime/model.hpp"

namespace catena {

/// The forward dynamics of a batch of eight parameter sets and states, for studies that evaluate
/// many: the processor's vector registers hold the same number of several sets (8 with AVX-512, 4
/// with AVX2, else 2, or 1), chosen when the program runs. Every set gets the bits that
/// Model::acceleration gives it alone. Allocates when made, not when used; not to be shared between
/// threads.
///
///     const Model model = Model::built_in(4);
///     const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.parameters(), 0.1);
///     BatchDynamics batch(model);
///     for (int k = 0; k < BatchDynamics::kBatch; ++k) {
///       batch.set_parameters(k, parameters);
///       batch.q(k, 0) = 0.1 * k;  // rad
///     }
///     if (batch.evaluate(0.0) == 0) {
///       const double first = batch.acceleration(7, 0);  // rad/s^2, of the eighth set
///     }
class BatchDynamics {
 public:
  static constexpr int kBatch = 8;

  /// All parameters, states and signals are zero until set.
  explicit BatchDynamics(const Model& model);

  /// Of set k = 0..7. Throws std::invalid_argument if there is no such set or the model does not
  /// take the parameters (Model::check_parameters).
  void set_parameters(int k, const Eigen::VectorXd& p);

  /// Entry i, from 0, of set k, to be read and written: coordinates, velocities, extra states, and
  /// u of catena_model.h (value, first and second derivative of each signal). Not checked.
  double& q(int k, int i) { return q_.of(k, i); }
  double& v(int k, int i) { return v_.of(k, i); }
  double& z(int k, int i) { return z_.of(k, i); }
  double& u(int k, int i) { return u_.of(k, i); }

  /// Solves r(t, q, v, a, z) = 0, (3.4), for a in all eight sets. Returns 0, or the 1-based
  /// coordinate whose pivot is not positive in some set: then no acceleration is to be used.
  int evaluate(double t);

  /// d2q_i/dt2, i from 0, of set k: rad/s^2 for angles.
  double acceleration(int k, int i) const { return a_.of(k, i); }

 private:
  // Entry i of eight sets, in groups of as many sets as one call takes.
  class Packed {
   public:
    Packed(int entries, int sets)
        : entries_(entries), sets_(sets), values_(static_cast<std::size_t>(kBatch * entries)) {}
    double* group(int first) { return values_.data() + first * entries_; }
    double& of(int k, int i) { return values_[place(k, i)]; }
    double of(int k, int i) const { return values_[place(k, i)]; }

   private:
    template <class T>
    struct Aligned {  // to the widest register
      using value_type = T;
      Aligned() = default;
      template <class U>
      Aligned(const Aligned<U>&) {}
      T* allocate(std::size_t n) {
        return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64)));
      }
      void deallocate(T* at, std::size_t) { ::operator delete(at, std::align_val_t(64)); }
      bool operator==(const Aligned&) const = default;
    };
    std::size_t place(int k, int i) const {  // sets_ is a power of two
      const int within = k & (sets_ - 1);
      return static_cast<std::size_t>((k - within) * entries_ + i * sets_ + within);
    }

    int entries_, sets_;
    std::vector<double, Aligned<double>> values_;
  };

  Model model_;
  Packed q_, v_, z_, u_, p_, a_;
};

}  // namespace catena
