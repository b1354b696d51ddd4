// SPDX-License-Identifier: GPL-3.0-or-later
#include "chain_12.hpp"
#include "chain_2.hpp"
#include "chain_3.hpp"
#include "chain_4.hpp"
#include "chain_60.hpp"
#include "tests/generated/emitted_functions.hpp"

namespace catena::tests {
namespace {

CATENA_EMITTED(chain_2)
CATENA_EMITTED(chain_3)
CATENA_EMITTED(chain_4)
CATENA_EMITTED(chain_12)
CATENA_EMITTED(chain_60)

}  // namespace

std::vector<EmittedModel> emitted_chains() {
  return {CATENA_MODEL(chain_2, values_chain_2, tangents_chain_2),
          CATENA_MODEL(chain_3, values_chain_3, tangents_chain_3),
          CATENA_MODEL(chain_4, values_chain_4, tangents_chain_4),
          CATENA_MODEL(chain_12, values_chain_12, tangents_chain_12),
          CATENA_MODEL(chain_60, values_chain_60, tangents_chain_60)};
}

}  // namespace catena::tests
