// Records builds and refits in batches whose scratch memory fits one buffer.
#pragma once

#include <vector>

#include "LanternScene/Scene.h"

namespace Lantern
{

class FGeometryBuilder
{
public:
	FGeometryBuilder(IRTDevice& InDevice, TRTRef<IRTBuffer>& InScratch) : Device(InDevice), Scratch(InScratch) {}
	/// Creates the structures of those that have none, refits those that allow it (see RebuildInterval), builds the others.
	/// Ends with a barrier.
	FRTStatus Build(IRTCommandList& List, const std::vector<FRTGeometryRef>& Geometries, uint32_t RebuildInterval, FSceneUpdateStats& Stats);
	FRTStatus ReserveScratch(uint64_t Bytes);

private:
	FRTStatus Create(FRTGeometry& Geometry);
	IRTDevice& Device;
	TRTRef<IRTBuffer>& Scratch;
};

} // namespace Lantern
