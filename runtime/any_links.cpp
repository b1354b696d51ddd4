// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/any_links.hpp"

#include <array>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "generated/chain_any.hpp"

namespace catena {
namespace {

static_assert(kFewestLinks == chain_any::kFewestLinks);

/// A table with the names in it.
class AnyLinks {
 public:
  AnyLinks(int place, int links) : table_(chain_any::table_at_place(place, links)) {
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
  static std::mutex mutex;
  static std::array<std::weak_ptr<const AnyLinks>, kPlaces> places;
  const std::lock_guard lock(mutex);
  int free = -1;
  for (int place = 0; place < kPlaces; ++place) {
    const auto there = places[static_cast<std::size_t>(place)].lock();
    if (there && there->table().links == links)
      return Model(std::shared_ptr<const catena_model>(there, &there->table()));
    if (!there && free < 0) free = place;
  }
  if (free < 0)
    throw InputError("a model of " + std::to_string(links) + " links: models of " +
                     std::to_string(kPlaces) +
                     " other numbers of links are in use, which is the most; let one go");
  const auto made = std::make_shared<const AnyLinks>(free, links);
  places[static_cast<std::size_t>(free)] = made;
  return Model(std::shared_ptr<const catena_model>(made, &made->table()));
}

}  // namespace catena
