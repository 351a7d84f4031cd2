# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# find_package(cusp COMPONENTS …): one export file per room, loaded with the rooms it depends on.
