// SPDX-License-Identifier: BSD-3-Clause
// Its headers are those of the target that it is compiled for.
