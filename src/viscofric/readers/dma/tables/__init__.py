"""DMA tables with headings and units, in text or in a workbook, as laboratories write them."""
