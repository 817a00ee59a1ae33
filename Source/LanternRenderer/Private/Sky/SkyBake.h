// The map that a sky's program is baked into.
#pragma once

#include "PassTools.h"
#include "SkyTypes.h"

namespace Lantern
{

/// r.RT.Sky.Bake. Off: whatever asks for the sky's radiance runs its program.
bool IsSkyBaked();

/// Returns how much of what a program gets has changed, 0 to 1: as part of the longer of each two vectors, or radians of the sun's way.
/// Its time is no part of it.
double GetSkyChange(const FSkyData& Before, const FSkyData& Now);

void ListSkyShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);

/// Bakes the program into an octahedral map, some tiles a frame, and then fades from the map that is shown to the new one. A map in one
/// piece takes the place of 3 or 4 layers of clouds for each ray that leaves the scene. A world has one map, whatever its views are.
/// Threads: the render thread.
class FSkyBake
{
public:
	explicit FSkyBake(IRTDevice& InDevice) : Device(InDevice) {}
	/// Adds the frame's part of it, and sets FWorldOfFrame::SkyChange. Does nothing, and frees the maps, without a program. bRead: something in
	/// the frame asks for the sky's radiance. Where the map cannot be made, the frame's facts know of no program.
	FRTStatus AddPasses(FFrameContext& Context, FFrameUploads& Uploads, uint32_t ViewIndex, bool bRead);
	/// Makes the map the sky of the frame's constants, if there is one.
	void FillConstants(FSceneConstants& InOut) const;
	/// bSubmitted false: nothing of the frame reaches the maps, which are then made anew.
	void EndFrame(bool bSubmitted);

private:
	struct FMap
	{
		TRTRef<IRTTexture> Texture;
		bool bWritten = false;
	};
	/// What a frame does.
	struct FStep
	{
		uint32_t FirstTile = 0, TileCount = 0;
		float Fade = 0.0f; ///< share of the way that is left from what is shown to what is baked; 0: nothing is shown anew
	};
	FRTStatus Prepare(uint32_t Size);
	FRTStatus CreateMap(const char* Name, uint32_t Size, FMap& Out);
	FStep Advance(const FSkyData& Now, const FView& View);
	FRTStatus AddMapPasses(FFrameContext& Context, FFrameUploads& Uploads, const FSkyData& Now);
	bool TakesTurn(const FFrameContext& Context, uint32_t ViewIndex);
	FRTStatus AddBakePass(FFrameContext& Context, FFrameUploads& Uploads, IRTPipeline* Pipeline, const FStep& Step, FGraphTexture Target);
	void AddFadePass(FFrameContext& Context, IRTPipeline* Pipeline, float Share, FGraphTexture From, FGraphTexture Target);
	void Free();

	IRTDevice& Device;
	TRTRef<IRTSampler> Sampler;
	FMap Baked, Shown;
	FSkyData Round{};                     ///< what the tiles of Baked get
	double Done = 1.0;                    ///< share of the round's tiles
	double FadeLeft = 0.0;                ///< seconds
	double Leap = 0.0;                    ///< by how much the sky of Baked differs from what was shown; 0: clouds have drifted
	double Change = 0.0;                  ///< FWorldOfFrame::SkyChange of the last frame that took its turn
	FSkyData Last{};                      ///< of the last frame
	FAddress Data = 0;                    ///< of this frame
	uint64_t LastWorld = 0;               ///< identity of its scene's sections
	bool bUsed = false;                   ///< this frame shows the map
	uint32_t TurnView = 0, TurnFrame = 0; ///< the view whose frames the time is taken from, and its last one
};

} // namespace Lantern
