// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The readers of single formats; each takes the whole stream and leaves points and problems in the collector.
#pragma once

#include "points/byte_source.hpp"
#include "points/point_collector.hpp"

namespace cusp::inspect {

void readTable(ByteSource& source, const PointReaderOptions& options, PointCollector& out);
void readDmis(ByteSource& source, PointCollector& out);
void readPcDmis(ByteSource& source, PointCollector& out);
void readCalypso(ByteSource& source, const PointReaderOptions& options, PointCollector& out);
void readPcd(ByteSource& source, PointCollector& out);
void readPly(ByteSource& source, PointCollector& out);
void readQifPoints(ByteSource& source, PointCollector& out);

}  // namespace cusp::inspect
