// SPDX-License-Identifier: BSD-3-Clause
#include "logs/row_table.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace scoria::logs {
namespace {

std::string CellOf(const RowTable& table, std::span<const std::string> cells,
                   const std::string& column) {
  const auto& columns = table.columns();
  const auto at = std::find(columns.begin(), columns.end(), column);
  return at == columns.end() ? "no such column" : cells[at - columns.begin()];
}

TEST(RowTable, HasAColumnPerNumberAndEmptyCellsForWhatIsAbsent) {
  RowTable table(RowGroups().set());
  Row row;
  row.time_s = 0.1;
  row.truth.emplace().p_WB_m = {1.0 / 3.0, 0.0, -2.0};
  row.episode = {123'456'789'012, true, false, 3};
  row.contacts.emplace().source = {1, 2, 3, 255};
  const auto cells = table.Read(row);
  ASSERT_EQ(cells.size(), table.columns().size());
  EXPECT_EQ(cells[0], "0.1");
  const auto cell = [&](const char* column) { return CellOf(table, cells, column); };
  EXPECT_EQ(cell("truth.p_WB_m[0]"), "0.3333333333333333");
  EXPECT_EQ(cell("truth.p_WB_m[2]"), "-2");
  EXPECT_EQ(cell("truth.ground_z_m"), "");
  EXPECT_EQ(cell("episode.step"), "123456789012");
  EXPECT_EQ(cell("episode.operating"), "1");
  EXPECT_EQ(cell("contacts.source[3]"), "255");
  EXPECT_EQ(cell("contacts.sensor.contact[1]"), "");
  EXPECT_EQ(cell("measured.q_rad[11]"), "");
  EXPECT_EQ(cell("estimate.innovation.dof"), "");
}

TEST(RowTable, HasTheGroupsThatItIsMadeFor) {
  RowTable table(RowGroups().set(static_cast<std::size_t>(RowGroup::kCommand)));
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"time_s", "command.v_x_mps",
                                                       "command.v_y_mps", "command.w_z_radps"}));
  EXPECT_EQ(table.Read(Row{}).size(), 4u);
}

}  // namespace
}  // namespace scoria::logs
