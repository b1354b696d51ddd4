// SPDX-License-Identifier: BSD-3-Clause
//
// Tables of functions (catena_model.h) for numbers of links that are known only when the program
// runs. A pointer in a table carries nothing but code, so that the number has to be found by it:
// there are `kPlaces` sets of small functions, each of which looks up the number of links of its
// place and calls the one function that does the work for any number.
#pragma once

#include <atomic>
#include <utility>

#include "catena_model.h"

namespace catena {

/// A parameter of the chain. of_each_link: name_1 ... name_n, and the number ends the description.
struct ParameterFamily {
  catena_parameter parameter;
  bool of_each_link;
};

/// So many tables can be in use at the same time.
inline constexpr int kPlaces = 64;

/// `function`, a member of Functions (an aggregate that begins with the number of links), as the
/// table of a place has it.
template <class Functions, int place>
struct AtPlace {
  static inline std::atomic<int> links = 0;

  template <auto function>
  struct Call;
  template <class Result, class... Arguments, Result (Functions::*function)(Arguments...)>
  struct Call<function> {
    static Result of(Arguments... arguments) {
      return (Functions{{links}}.*function)(arguments...);
    }
  };
};

/// make.operator()<place>(links), the place being known only at run time.
template <class Make, int... places>
catena_model table_at_place(int place, int links, const Make& make,
                            std::integer_sequence<int, places...>) {
  catena_model table{};
  ((place == places ? void(table = make.template operator()<places>(links)) : void()), ...);
  return table;
}
template <class Make>
catena_model table_at_place(int place, int links, const Make& make) {
  return table_at_place(place, links, make, std::make_integer_sequence<int, kPlaces>());
}

}  // namespace catena
