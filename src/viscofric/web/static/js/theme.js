// Light or dark as chosen before, ahead of the first paint.
try {
  const theme = JSON.parse(localStorage.getItem("viscofric.theme"));
  if (theme) document.documentElement.dataset.theme = theme;
} catch {
  // Without storage the system's choice holds.
}
