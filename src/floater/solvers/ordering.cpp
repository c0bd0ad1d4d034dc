// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/ordering.h"

#include "floater/solvers/nested_dissection.h"

#include <amd.h>
#include <cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl::floater {
namespace {
void
fail (const char* call, int status, bool is_out_of_memory)
{
  if (is_out_of_memory)
    throw std::bad_alloc ();
  throw std::runtime_error (std::string (call) + ": status " + std::to_string (status));
}

// Approximate minimum degree (Amestoy, Davis and Duff 1996).
std::vector<int>
orderByAmd (const LinearSystem& system)
{
  std::vector<int> order (system.unknowns ());
  const int status =
      amd_order (static_cast<int> (system.unknowns ()), system.row_offsets.data (),
                 system.columns.data (), order.data (), nullptr, nullptr); // defaults, no figures
  if (status != AMD_OK)
    fail ("amd_order", status, status == AMD_OUT_OF_MEMORY);
  return order;
}

// The workspace of CHOLMOD. Errors are told by its status alone and never printed.
class CholmodWorkspace
{
public:
  CholmodWorkspace ()
  {
    cholmod_start (&common_);
    common_.print = 0;
  }
  ~CholmodWorkspace () { cholmod_finish (&common_); }
  CholmodWorkspace (const CholmodWorkspace&) = delete;
  CholmodWorkspace& operator= (const CholmodWorkspace&) = delete;

  cholmod_common* get () { return &common_; }
  int status () const { return common_.status; }

private:
  cholmod_common common_{};
};

// Nested dissection by METIS (Karypis and Kumar 1998), then along the elimination tree.
std::vector<int>
orderByMetis (const LinearSystem& system)
{
  const CsrLists symmetric = symmetricPattern (system);
  std::vector<int> offsets (symmetric.offsets.begin (), symmetric.offsets.end ());
  std::vector<int> rows (symmetric.ids.begin (), symmetric.ids.end ());
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = system.unknowns ();
  pattern.nzmax = rows.size ();
  pattern.p = offsets.data ();
  pattern.i = rows.data ();
  pattern.stype = 1; // symmetric, read from its upper triangle
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.packed = 1;
  CholmodWorkspace workspace;
  std::vector<int> order (system.unknowns ());
  constexpr int POSTORDER = 1;
  if (cholmod_metis (&pattern, nullptr, 0, POSTORDER, order.data (), workspace.get ()) == 0)
    fail ("cholmod_metis", workspace.status (), workspace.status () == CHOLMOD_OUT_OF_MEMORY);
  return order;
}

} // namespace

std::vector<int>
orderUnknowns (const LinearSystem& system, Ordering ordering)
{
  if (system.unknowns () == 0)
    return {};
  switch (ordering) {
  case Ordering::NATURAL: {
    std::vector<int> order (system.unknowns ());
    std::iota (order.begin (), order.end (), 0);
    return order;
  }
  case Ordering::REVERSE_CUTHILL_MCKEE:
    return reverseCuthillMckee (system);
  case Ordering::AMD:
    return orderByAmd (system);
  case Ordering::METIS:
    return orderByMetis (system);
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

} // namespace pcl::floater
