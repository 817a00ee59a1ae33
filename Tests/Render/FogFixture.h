// Light in fog as frames have it, read back, and where its froxels lie.
#pragma once

#include <functional>
#include <vector>

#include "FogTypes.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

/// The atlas of one frame.
struct FFogPicture
{
	FFogGrid Grid{};
	std::vector<float> Visibility; ///< by texel; empty: there is none
	std::vector<glm::vec3> Light;  ///< as Visibility
	size_t GetTexel(glm::uvec3 Froxel) const
	{
		const size_t Row = Froxel.y + size_t(Froxel.z / Grid.PerRow) * Grid.Rows;
		return Row * Grid.Columns * Grid.PerRow + Froxel.x + size_t(Froxel.z % Grid.PerRow) * Grid.Columns;
	}
	float Get(glm::uvec3 Froxel) const { return Visibility[GetTexel(Froxel)]; }
	glm::vec3 GetLight(glm::uvec3 Froxel) const { return Light[GetTexel(Froxel)]; }
	void ForEach(const std::function<void(glm::uvec3)>& Visit) const;
};

/// World position of a place in columns, rows and slices: the formula of FRTModuleFog, in double precision.
glm::dvec3 FroxelToWorld(const FView& View, const FFogGrid& Grid, glm::dvec3 Place);

class FFogTest : public FRenderTest
{
protected:
	void SetUp() override;
	void TearDown() override;
	/// Renders frames, and reads the atlas of the last one.
	FFogPicture RenderFog(const FView& View, uint32_t Frames = 1);
	/// As RenderFog, of indirect light. OutMoments: by texel.
	FFogPicture RenderVolume(const FView& View, uint32_t Frames, std::vector<glm::vec3>& OutMoments);
	/// Mean of the atlases of Frames frames. Settings decide how much they know of each other.
	FFogPicture MeanFog(const FView& View, uint32_t Frames);
	static FRTScene& GetWorld() { return GetScene().GetScene(); }

private:
	void RenderFrames(const FView& View, uint32_t Frames);
	static std::vector<glm::vec3> UnpackHalves(const TRTRef<IRTBuffer>& Buffer);
	void AddRead(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out);
};

} // namespace Lantern
