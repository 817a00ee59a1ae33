// Measures how much frames of a still view change.
#include "LanternMeasure/Settling.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include "LanternImage/ImageStatistics.h"

namespace Lantern
{

namespace
{
std::vector<float> ListLuminances(const FImage& Image)
{
	std::vector<float> Out;
	Out.reserve(size_t(Image.Width) * Image.Height);
	for (uint32_t Y = 0; Y < Image.Height; ++Y)
	{
		for (uint32_t X = 0; X < Image.Width; ++X)
		{
			const float L = GetLuminance(Image, X, Y);
			Out.push_back(std::isfinite(L) ? L : 0.0f);
		}
	}
	return Out;
}

double GetChange(const std::vector<float>& Before, const std::vector<float>& Now)
{
	const double Count = double(Now.size());
	const double Mean = std::accumulate(Now.begin(), Now.end(), 0.0) / Count;
	double Sum = 0.0;
	for (size_t I = 0; I < Now.size(); ++I)
	{
		const double Difference = std::abs(double(Now[I]) - Before[I]);
		Sum += Difference > 0.0 ? Difference / (Now[I] + Mean) : 0.0;
	}
	return Sum / Count;
}

double SumOf(const std::vector<double>& Values, size_t First, size_t Count)
{
	return std::accumulate(Values.begin() + First, Values.begin() + First + Count, 0.0);
}
} // namespace

bool FSettling::Add(const FImage& Radiance)
{
	std::vector<float> Now = ListLuminances(Radiance);
	assert(Previous.empty() || Previous.size() == Now.size());
	if (!Previous.empty()) { Changes.push_back(GetChange(Previous, Now)); }
	Previous = std::move(Now);
	const size_t Count = Changes.size();
	if (Count > 0 && Changes.back() < InvisibleChange) { return true; }
	return Count >= 2 * Window && SumOf(Changes, Count - Window, Window) >= FallingShare * SumOf(Changes, Count - 2 * Window, Window);
}

} // namespace Lantern
