// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/ordering.h"

#include <umfpack.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

namespace pcl
{
namespace floater
{
namespace
{
struct FreeSymbolic
{
  void operator() (void* handle) const { umfpack_di_free_symbolic (&handle); }
};

void
accept (int status, const char* call)
{
  if (status == UMFPACK_ERROR_out_of_memory)
    throw std::bad_alloc ();
  if (status != UMFPACK_OK)
    throw std::runtime_error (std::string (call) + ": UMFPACK status " + std::to_string (status));
}

// The column order that UMFPACK's symmetric strategy would use: fill-reducing, then along the
// elimination tree.
std::vector<int>
orderByUmfpack (const LinearSystem& system, int ordering)
{
  const auto n = static_cast<int> (system.unknowns ());
  std::array<double, UMFPACK_CONTROL> control{};
  umfpack_di_defaults (control.data ());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_ORDERING] = ordering;
  control[UMFPACK_SINGLETONS] = 0.0; // would come first, columns and rows in different orders
  void* handle = nullptr;
  const int status = umfpack_di_symbolic (n, n, system.row_offsets.data (), system.columns.data (),
                                          nullptr, &handle, control.data (), nullptr);
  const std::unique_ptr<void, FreeSymbolic> symbolic (handle);
  accept (status, "symbolic analysis");

  int rows = 0, columns = 0, singletons = 0, nonzeros = 0, fronts = 0, chains = 0;
  const auto size = static_cast<std::size_t> (n) + 1;
  std::vector<int> row_order (size), order (size);
  std::array<std::vector<int>, 7> of_fronts; // not used, but written
  for (std::vector<int>& one : of_fronts)
    one.resize (size);
  accept (umfpack_di_get_symbolic (&rows, &columns, &singletons, &nonzeros, &fronts, &chains,
                                   row_order.data (), order.data (), of_fronts[0].data (),
                                   of_fronts[1].data (), of_fronts[2].data (), of_fronts[3].data (),
                                   of_fronts[4].data (), of_fronts[5].data (), of_fronts[6].data (),
                                   handle),
          "ordering");
  order.pop_back ();
  return order;
}

} // namespace

std::vector<int>
orderUnknowns (const LinearSystem& system, Ordering ordering)
{
  switch (ordering) {
  case Ordering::NATURAL: {
    std::vector<int> order (system.unknowns ());
    std::iota (order.begin (), order.end (), 0);
    return order;
  }
  case Ordering::REVERSE_CUTHILL_MCKEE:
    return reverseCuthillMckee (system);
  case Ordering::AMD:
    return orderByUmfpack (system, UMFPACK_ORDERING_AMD);
  case Ordering::METIS:
    return orderByUmfpack (system, UMFPACK_ORDERING_METIS);
  case Ordering::AUTOMATIC:
  case Ordering::COLAMD:
    break;
  }
  throw std::invalid_argument ("not a symmetric ordering");
}

LinearSystem
permuteSystem (const LinearSystem& system, const std::vector<int>& order)
{
  const std::size_t n = system.unknowns ();
  std::vector<int> place (n);
  for (std::size_t i = 0; i < n; ++i)
    place[static_cast<std::size_t> (order[i])] = static_cast<int> (i);

  LinearSystem permuted;
  permuted.unknown_of_point = system.unknown_of_point;
  for (Index& unknown : permuted.unknown_of_point)
    if (unknown != NONE)
      unknown = static_cast<Index> (place[unknown]);
  permuted.point_of_unknown.reserve (n);
  permuted.row_offsets.reserve (n + 1);
  permuted.columns.reserve (system.nonzeros ());
  permuted.values.reserve (system.nonzeros ());
  permuted.row_offsets.push_back (0);
  std::vector<std::pair<int, double>> row;
  for (const int from : order) {
    const auto i = static_cast<std::size_t> (from);
    row.clear ();
    for (int entry = system.row_offsets[i]; entry < system.row_offsets[i + 1]; ++entry) {
      const auto at = static_cast<std::size_t> (entry);
      row.emplace_back (place[static_cast<std::size_t> (system.columns[at])], system.values[at]);
    }
    std::sort (row.begin (), row.end ());
    for (const auto& [column, value] : row) {
      permuted.columns.push_back (column);
      permuted.values.push_back (value);
    }
    permuted.row_offsets.push_back (static_cast<int> (permuted.columns.size ()));
    permuted.point_of_unknown.push_back (system.point_of_unknown[i]);
    permuted.rhs_u.push_back (system.rhs_u[i]);
    permuted.rhs_v.push_back (system.rhs_v[i]);
  }
  return permuted;
}

} // namespace floater
} // namespace pcl
