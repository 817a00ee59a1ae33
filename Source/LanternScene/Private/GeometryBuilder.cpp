#include "GeometryBuilder.h"

#include <algorithm>

namespace Lantern
{

namespace
{
// A batch takes what fits into this much scratch, and at least one geometry.
constexpr uint64_t BatchScratchBytes = 32ull << 20;
} // namespace

FRTStatus FGeometryBuilder::Create(FRTGeometry& Geometry)
{
	if (Geometry.Structure) { return FRTStatus::Success(); }
	const std::vector<FRTGeometrySection> Sections = MakeStructureSections(Geometry);
	FRTGeometryDesc Desc;
	Desc.Sections = Sections.data();
	Desc.SectionCount = static_cast<uint32_t>(Sections.size());
	Desc.bAllowUpdate = Geometry.Info.bDynamic;
	Desc.bFastBuild = Geometry.Info.bDynamic;
	Desc.Name = Geometry.Info.Name.c_str();
	return Device.CreateGeometry(Desc, Geometry.Structure.ReleaseAndGetAddress());
}

FRTStatus FGeometryBuilder::ReserveScratch(uint64_t Bytes)
{
	if (Scratch && Scratch->GetDesc().Size >= Bytes) { return FRTStatus::Success(); }
	return Device.CreateBuffer({Bytes, ERTBufferUsage::Scratch | ERTBufferUsage::Storage, ERTMemory::Device, "BuildScratch"}, Scratch.ReleaseAndGetAddress());
}

FRTStatus FGeometryBuilder::Build(IRTCommandList& List, const std::vector<FRTGeometryRef>& Geometries, uint32_t RebuildInterval, FSceneUpdateStats& Stats)
{
	const uint64_t Alignment = std::max(1u, Device.GetCapabilities().ScratchAlignment);
	const FRTBarrier Between{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead | ERTAccess::TraceRead};
	for (size_t Next = 0; Next < Geometries.size();)
	{
		std::vector<std::vector<FRTGeometrySection>> Sections;
		std::vector<FRTGeometryBuild> Builds;
		uint64_t Used = 0;
		for (; Next < Geometries.size(); ++Next)
		{
			FRTGeometry& Geometry = *Geometries[Next];
			if (FRTStatus S = Create(Geometry); !S) { return S; }
			const bool bUpdate = Geometry.bBuilt && Geometry.Info.bDynamic && Geometry.RefitsSinceBuild + 1 < RebuildInterval;
			const FRTBuildSizes Sizes = Geometry.Structure->GetBuildSizes();
			const uint64_t Bytes = bUpdate ? Sizes.UpdateScratchBytes : Sizes.BuildScratchBytes;
			if (!Builds.empty() && Used + Bytes > BatchScratchBytes) { break; }
			Sections.push_back(MakeStructureSections(Geometry));
			FRTGeometryBuild Build;
			Build.Geometry = Geometry.Structure.Get();
			Build.SectionCount = static_cast<uint32_t>(Sections.back().size());
			Build.bUpdate = bUpdate;
			Build.ScratchOffset = Used;
			Builds.push_back(Build);
			Used = (Used + Bytes + Alignment - 1) / Alignment * Alignment;
			Geometry.bBuilt = true;
			Geometry.RefitsSinceBuild = bUpdate ? Geometry.RefitsSinceBuild + 1 : 0;
			++(bUpdate ? Stats.GeometriesRefitted : Stats.GeometriesBuilt);
		}
		if (FRTStatus S = ReserveScratch(std::max<uint64_t>(Used, Alignment)); !S) { return S; }
		for (size_t I = 0; I < Builds.size(); ++I)
		{
			Builds[I].Sections = Sections[I].data();
			Builds[I].Scratch = Scratch.Get();
		}
		List.BuildGeometries(Builds.data(), static_cast<uint32_t>(Builds.size()));
		List.Barriers(&Between, 1);
	}
	return FRTStatus::Success();
}

} // namespace Lantern
