// A patch of a landscape: heights that an engine may edit, and the mesh that they make.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "LanternModule/ModuleMesh.h"

namespace Lantern
{

/// Ok, or InvalidArgument, which names the member.
FRTStatus CheckLandscape(const FRTModuleLandscape& Patch);

class FLandscapePatch
{
public:
	/// Patch: checked.
	explicit FLandscapePatch(const FRTModuleLandscape& Patch);

	/// The mesh that the heights make, with arrays that last until the next call. No other call may run meanwhile.
	FRTModuleMesh MakeMesh();
	/// Takes new heights over, and calls Then with all positions and normals. InvalidArgument names the member. Any thread.
	template <class FThen>
	FRTStatus SetHeights(const FRTModuleHeights& New, FThen Then)
	{
		if (const FRTStatus Status = CheckHeights(New); !Status) { return Status; }
		std::lock_guard Lock(Mutex); // later heights must not be overtaken by earlier ones
		Store(New);
		MakeVertices();
		return Then(Positions.data(), Normals.data());
	}

private:
	FRTStatus CheckHeights(const FRTModuleHeights& New) const;
	void Store(const FRTModuleHeights& New);
	float GetHeight(uint32_t Column, uint32_t Row) const;
	void MakeVertices();
	void MakeIndices(const uint8_t* Holes, uint32_t HolesPitch);

	const std::string Name;
	const uint32_t Columns, Rows;
	const float SpacingX, SpacingY, HeightScale, HeightOffset;
	std::mutex Mutex;              ///< of what follows
	std::vector<uint16_t> Heights; ///< Rows of Columns
	std::vector<float> Positions, Normals, UVs;
	std::vector<uint32_t> Indices;
};

} // namespace Lantern
