// FAlphaPyramid: levels of least and greatest alpha.
#include <algorithm>
#include <cassert>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternScene/Opacity/OpacityClassifier.h"

namespace Lantern
{

namespace
{
constexpr size_t RowsPerTask = 64;
} // namespace

FAlphaPyramid::FAlphaPyramid(const FAlphaTexels& InTexels) : Texels(InTexels)
{
	assert(Texels.Alpha && Texels.Width > 0 && Texels.Height > 0 && Texels.TexelBytes > 0);
	for (uint32_t Width = Texels.Width, Height = Texels.Height; Width > 1 || Height > 1;)
	{
		FLevel Level;
		Level.Width = (Width + 1) / 2;
		Level.Height = (Height + 1) / 2;
		Level.Ranges.resize(size_t(Level.Width) * Level.Height);
		const uint32_t Below = static_cast<uint32_t>(Levels.size());
		ParallelFor(Level.Height, RowsPerTask, [&](size_t Begin, size_t End) {
			for (size_t Row = Begin; Row < End; ++Row)
			{
				const uint32_t Y0 = static_cast<uint32_t>(2 * Row), Y1 = std::min(Y0 + 1, Height - 1);
				for (uint32_t X = 0; X < Level.Width; ++X)
				{
					const uint32_t X0 = 2 * X, X1 = std::min(X0 + 1, Width - 1);
					const FAlphaRange R[4] = {
					    GetRange(Below, X0, Y0), GetRange(Below, X1, Y0), GetRange(Below, X0, Y1), GetRange(Below, X1, Y1)};
					Level.Ranges[Row * Level.Width + X] = {
					    std::min({R[0].Min, R[1].Min, R[2].Min, R[3].Min}), std::max({R[0].Max, R[1].Max, R[2].Max, R[3].Max})};
				}
			}
		});
		Width = Level.Width;
		Height = Level.Height;
		Levels.push_back(std::move(Level));
	}
}

} // namespace Lantern
