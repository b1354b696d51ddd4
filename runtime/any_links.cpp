// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/any_links.hpp"

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "generated/chain_any.hpp"

namespace catena {
namespace {

static_assert(kFewestLinks == chain_any::kFewestLinks);

/// A table with its context and the names in it.
class AnyLinks {
 public:
  explicit AnyLinks(int links) : chain_{links}, table_(chain_any::table(chain_)) {
    const auto kept = [this](std::string text) {
      return texts_.emplace_back(std::move(text)).c_str();
    };
    for (int i = 1; i <= links; ++i) {
      const catena_quantity& theta = chain_any::kCoordinate;
      coordinates_.push_back({kept(theta.name + ("_" + std::to_string(i))), theta.unit});
    }
    for (const auto& [parameter, of_each_link] : chain_any::kParameters) {
      if (!of_each_link) parameters_.push_back(parameter);
      for (int i = 1; of_each_link && i <= links; ++i) {
        const std::string number = std::to_string(i);
        catena_parameter& one = parameters_.emplace_back(parameter);
        one.name = kept(parameter.name + ("_" + number));
        one.description = kept(parameter.description + (" " + number));
      }
    }
    table_.id = kept("chain_" + std::to_string(links));
    table_.coordinate = coordinates_.data();
    table_.state = table_.signal = &kNone;
    table_.parameter = parameters_.data();
  }
  AnyLinks(const AnyLinks&) = delete;
  AnyLinks& operator=(const AnyLinks&) = delete;

  const catena_model& table() const { return table_; }

 private:
  static constexpr catena_quantity kNone = {nullptr, nullptr};

  chain_any::Chain chain_;
  std::deque<std::string> texts_;
  std::vector<catena_quantity> coordinates_;
  std::vector<catena_parameter> parameters_;
  catena_model table_;
};

}  // namespace

Model any_links_model(int links) {
  if (links < kFewestLinks) return Model::built_in(links);
  if (links > kMostLinks)
    throw InputError("a model of " + std::to_string(links) + " links: at most " +
                     std::to_string(kMostLinks) + " are possible");
  const auto made = std::make_shared<const AnyLinks>(links);
  return Model(std::shared_ptr<const catena_model>(made, &made->table()));
}

}  // namespace catena
