// The explanation of a pixel.
#include "Feedback/PixelExplainer.h"

#include <charconv>
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "RadianceCellTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<std::string> CVarExplain("r.RT.Debug.Explain", "",
    "Pixel whose light is explained, as X,Y from the upper left corner. Looks up the radiance cells that a path's end would try there, and "
    "the light cell. Empty: none.");

std::optional<uint32_t> Known(uint32_t Number)
{
	return Number == EXPLAINED_UNKNOWN ? std::optional<uint32_t>() : std::optional<uint32_t>(Number);
}

FPixelExplanation MakeExplanation(const FExplainedPixel& Of)
{
	FPixelExplanation Out;
	Out.bSurface = Of.bSurface != 0;
	if (!Out.bSurface) { return Out; }
	Out.Position = Of.Position;
	Out.Normal = Of.Normal;
	Out.Used = Known(Of.Used);
	Out.LightCell = Known(Of.LightCell);
	Out.ListedLights = Known(Of.ListedLights);
	for (size_t I = 0; I < Out.Cells.size(); ++I)
	{
		const FExplainedCell& Cell = Of.Cells[I];
		if (Cell.Slot == EXPLAINED_UNKNOWN) { continue; }
		Out.Cells[I] = {Cell.Slot, Cell.Key, std::ldexp(RADIANCE_CELL_FINEST, int(Cell.Level)), Cell.Updates, Cell.SinceUpdate,
		    Cell.SinceLookUp, Cell.Light, Cell.Place};
	}
	return Out;
}
} // namespace

std::optional<glm::uvec2> ParsePixel(std::string_view Text)
{
	glm::uvec2 Pixel{0};
	const char* const End = Text.data() + Text.size();
	const auto [Comma, First] = std::from_chars(Text.data(), End, Pixel.x);
	if (First != std::errc() || Comma == End || *Comma != ',') { return {}; }
	const auto [Last, Second] = std::from_chars(Comma + 1, End, Pixel.y);
	return Second == std::errc() && Last == End ? std::optional<glm::uvec2>(Pixel) : std::nullopt;
}

std::optional<glm::uvec2> GetExplainedPixel()
{
	const std::string& Text = CVarExplain.GetOnRenderThread();
	if (Text.empty()) { return {}; }
	if (const std::optional<glm::uvec2> Pixel = ParsePixel(Text)) { return Pixel; }
	LogOnce(ERTLogLevel::Warning, "r.RT.Debug.Explain: " + Quote(Text) + " is not X,Y of a pixel; no pixel is explained");
	return {};
}

FPixelExplainer::FPixelExplainer(IRTDevice& InDevice) : TGpuStatistics(InDevice, "ExplainedPixel", MakeExplanation) {}

} // namespace Lantern
