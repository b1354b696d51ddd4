// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/any_links.hpp"

#include <memory>
#include <string>

#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "generated/chain_any.hpp"

namespace catena {
namespace {

static_assert(kFewestLinks == chain_any::kFewestLinks);

}  // namespace

Model any_links_model(int links) {
  if (links < kFewestLinks) return Model::built_in(links);
  if (links > kMostLinks)
    throw InputError("a model of " + std::to_string(links) + " links: at most " +
                     std::to_string(kMostLinks) + " are possible");
  const auto made = std::make_shared<const AnyLinksModel<chain_any::Chain>>(links);
  return Model(std::shared_ptr<const catena_model>(made, &made->model()));
}

}  // namespace catena
