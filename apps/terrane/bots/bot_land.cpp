#include "apps/terrane/bots/bot_land.h"

#include "terrane/net/remote_session.h"

namespace terrane::app {

base::Result<net::SampleDigests> BotLand::prove(const net::WorldOffer& offer) {
    if (generator_ && offer.world == offer_.world && offer.samples == offer_.samples &&
        offer.packs == offer_.packs)
        return digests_;
    auto content = TERRANE_TRY(contentOf(packs, offer));
    content_ = std::move(content);
    auto generator = TERRANE_TRY(net::offeredGenerator(offer, *content_.blocks, content_.generators));
    generator_ = std::make_unique<gen::Generator>(std::move(generator));
    offer_ = offer;
    digests_ = net::sampleDigests(*generator_, offer.samples);
    heights_.clear();
    return digests_;
}

int BotLand::groundHeight(std::int32_t x, std::int32_t y) {
    const world::BlockPos pos{x, y, 0};
    const auto [found, isNew] = heights_.try_emplace(world::chunkOf(pos));
    if (isNew) {
        const world::Chunk chunk = generator_->generate(world::chunkOf(pos));
        for (std::size_t column = 0; column < 256; ++column) {
            int z = world::kChunkHeight - 1;
            while (z > 0 && chunk.block(static_cast<world::BlockIndex>(
                                column + 256 * static_cast<std::size_t>(z))) == world::kAir)
                --z;
            found->second[column] = static_cast<std::uint8_t>(z);
        }
    }
    return found->second[world::blockIndex(pos)];
}

}  // namespace terrane::app
