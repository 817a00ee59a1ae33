// Diffuse global illumination: paths through a white Lambert lobe about the shading normal.
#include "DiffuseGI/DiffuseGI.h"

#include "BruteForce/BruteForce.h"
#include "Denoise/Denoise.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable(
    "r.RT.GI", false, "Traces diffuse global illumination by paths. If off, ambient light of the sky stands in.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.GI.Samples", 1, "Number of diffuse global illumination paths per pixel.", {1, 64});
TRTConsoleVariable<int32_t> CVarBounces("r.RT.GI.Bounces", 1,
    "Number of surfaces that may reflect light before it reaches the one that is lit. The reference of as many bounces has one "
    "scattering event more, the last.",
    {1, 4});
// Where one path in a hundred finds a lamp, most neighbourhoods are dark in a frame, and a clamp to them would lose its light.
const FDenoiseVariables Denoise("r.RT.GI", FDenoiseDefaults{.bColor = true, .ClampSigma = 0.0f});
constexpr FBruteForcePass BruteForce{ESignal::DiffuseGI, CVarEnable, CVarSamples, CVarBounces};
} // namespace

FPassRays ChooseDiffuseGIRays(const FPassQuery& Query) { return ChooseBruteForceRays(BruteForce, Query); }

bool IsDiffuseGIFiltered(const FRTScene&) { return Denoise.IsEnabled(); }

void ListDiffuseGIFilters(const FRTScene&, std::vector<FShaderSource>& Out)
{
	if (Denoise.IsEnabled()) { ListDenoiseShaders(true, false, Denoise.Get(), Out); }
}

FGraphTexture AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FGraphTexture Radiance = AddBruteForcePass(BruteForce, Context, GBuffer);
	if (!Radiance.IsValid() || !Denoise.IsEnabled()) { return Radiance; }
	FDenoiseInputs Inputs;
	Inputs.Name = "DiffuseGI";
	Inputs.Signal = Radiance;
	return AddDenoise(Context, GBuffer, Inputs, Denoise);
}

} // namespace Lantern
