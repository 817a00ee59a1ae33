// The light mask as frames have it, read back.
#pragma once

#include <functional>
#include <vector>

#include "SignalFixture.h"

namespace Lantern
{

/// The mask of one frame, and what is not in it.
struct FMaskPicture
{
	uint32_t Width = 0, Height = 0; ///< pixels; 0: there is none
	uint32_t LightsWidth = 0, LightsHeight = 0;
	std::vector<uint32_t> Visibility, Lights; ///< by texel
	FImage Diffuse;                           ///< ESignal::LocalDiffuse
	uint32_t GetNumber(uint32_t X, uint32_t Y, uint32_t Slot) const { return Lights[size_t(Y / 8) * LightsWidth + X / 8 * 8 + Slot]; }
	/// 8: it has none.
	uint32_t FindSlot(uint32_t X, uint32_t Y, uint32_t Number) const;
	/// 0 to 15; of a light without a slot 0.
	uint32_t Get(uint32_t X, uint32_t Y, uint32_t Number) const;
	/// Mean over the picture, 0 to 1.
	double GetMean(uint32_t Number) const;
};

class FLightMaskTest : public FSignalTest
{
protected:
	void SetUp() override;
	void TearDown() override;
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	/// A floor at y = 0, and bars above it at 1.2 m that hide parts of what is higher.
	void LoadBars();
	/// Lamps of one size above the bars. Radius 0: points, else spheres.
	static std::vector<FLightId> AddLamps(uint32_t Count, float Radius = 0.0f);
	/// From below the bars: nothing but floor.
	static FView LookAtFloor(uint32_t Width, uint32_t Height, double Aside = 0.0);
	/// Renders one frame after those before it.
	FMaskPicture RenderMask(const FView& View);
	/// Renders one frame, and reads the mask by the shader that hosts include: what SampleLightMask returns of a light, by pixel.
	std::vector<float> ReadByShader(const FView& View, uint32_t Number);
	/// What a surface of albedo 1 reflects of a point lamp without range, over π, by its position on the floor; green.
	static double LightFloor(const FView& View, uint32_t X, uint32_t Y, const FSceneLight& Lamp);

private:
	void AddRead(FFrameContext& Context, FGraphTexture Texture, TRTRef<IRTBuffer>& Out);
};

} // namespace Lantern
