#include "PassTools.h"

namespace Lantern
{

IRTPipeline* RequireCompute(const FFrameContext& Context, const char* Path, std::vector<std::pair<std::string, std::string>> Defines)
{
	FShaderSource Source;
	Source.Path = Path;
	Source.Stage = ERTShaderStage::Compute;
	Source.Defines = std::move(Defines);
	IRTPipeline* Pipeline = nullptr;
	if (FRTStatus S = Context.Pipelines.GetCompute(Source, Pipeline); !S)
	{
		Context.Fail(S);
		return nullptr;
	}
	return Pipeline;
}

std::vector<std::pair<std::string, std::string>> MakeFactDefines(const FSceneFacts& Facts)
{
	std::vector<std::pair<std::string, std::string>> Defines;
	const auto Add = [&](bool bHas, const char* Name) {
		if (bHas) { Defines.emplace_back(Name, "1"); }
	};
	Add(Facts.bSun, "HAS_SUN");
	Add(Facts.bSky, "HAS_SKY");
	Add(Facts.Lights > 0, "HAS_LIGHTS");
	Add(Facts.bMasked, "HAS_MASKED");
	return Defines;
}

} // namespace Lantern
